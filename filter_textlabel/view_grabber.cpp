#include "view_grabber.h"
#include "view_listener.h"

#include <QApplication>
#include <QMdiArea>
#include <QMdiSubWindow>
#include <QWidget>

namespace textlabel {
namespace {

/// How likely a 3D window is the one that the user means: in the active document, clicked last, visible.
int Rank(const QWidget* area)
{
	int rank = 0;
	if (area->window()->focusWidget() == area) rank += 1;
	for (const QWidget* w = area; w; w = w->parentWidget()) {
		const auto* const document = qobject_cast<const QMdiSubWindow*>(w);
		if (document && document->mdiArea() && document->mdiArea()->activeSubWindow() == document) rank += 2;
	}
	return rank;
}

QWidget* MeshWindow()
{
	if (!qobject_cast<QApplication*>(QCoreApplication::instance())) return nullptr;
	QWidget* best = nullptr;
	for (QWidget* widget : QApplication::allWidgets()) {
		if (!widget->inherits("GLArea") || !widget->isVisible()) continue;
		if (!best || Rank(widget) > Rank(best)) best = widget;
	}
	return best;
}

Camera CameraOf(const Shotm& shot)
{
	Camera camera;
	const auto rotation = shot.Extrinsics.Rot();
	const auto viewpoint = shot.Extrinsics.Tra();
	for (int i = 0; i < 3; ++i) {
		camera.viewpoint[i] = double(viewpoint[i]);
		camera.right[i] = double(rotation[0][i]);
		camera.up[i] = double(rotation[1][i]);
		camera.backwards[i] = double(rotation[2][i]);
	}
	const auto& lens = shot.Intrinsics;
	camera.perspective = lens.cameraType == vcg::Camera<Scalarm>::PERSPECTIVE;
	camera.focalMm = double(lens.FocalMm);
	for (int i = 0; i < 2; ++i) {
		camera.pixelSizeMm[size_t(i)] = double(lens.PixelSizeMm[i]);
		camera.viewportPx[size_t(i)] = lens.ViewportPx[i];
		camera.centerPx[size_t(i)] = double(lens.CenterPx[i]);
	}
	Orthonormalize(camera);
	return camera;
}

}  // namespace

std::optional<Camera> CurrentView()
{
	QWidget* const window = MeshWindow();
	ViewListener listener;
	if (!window ||
	    !QObject::connect(window, SIGNAL(transmitShot(QString, Shotm)), &listener, SLOT(receive(QString, Shotm))))
		return {};
	QMetaObject::invokeMethod(window, "sendViewerShot", Qt::DirectConnection, Q_ARG(QString, ViewListener::name()));
	if (!listener.shot) return {};
	return CameraOf(*listener.shot);
}

bool HasWindow() { return MeshWindow() != nullptr; }

}  // namespace textlabel
