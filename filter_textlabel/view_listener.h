#pragma once
// The receiving end of GLArea's transmitShot signal.

#include "meshlab_api.h"

#include <QObject>
#include <QString>
#include <optional>

namespace textlabel {

/// Keeps the shot that a GLArea transmits under our name.
class ViewListener : public QObject {
	Q_OBJECT
public:
	static QString name() { return QStringLiteral("textlabel"); }
	std::optional<Shotm> shot;

public slots:
	void receive(QString receiver, Shotm sent)
	{
		if (receiver == name()) shot = sent;
	}
};

}  // namespace textlabel
