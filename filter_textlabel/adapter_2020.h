#pragma once
// The plugin for MeshLab 2020.09 and its meshlabserver.

#include <common/interfaces.h>

class TextLabelPlugin : public QObject, public MeshFilterInterface {
	Q_OBJECT
	MESHLAB_PLUGIN_IID_EXPORTER(MESH_FILTER_INTERFACE_IID)
	Q_INTERFACES(MeshFilterInterface)

public:
	TextLabelPlugin();
	QString pluginName() const override;
	QString filterName(FilterIDType) const override;
	QString filterInfo(FilterIDType) const override;
	FilterClass getClass(QAction*) override;
	FILTER_ARITY filterArity(QAction*) const override;
	int postCondition(QAction*) const override;
	void initParameterSet(QAction*, MeshModel& model, RichParameterList& list) override;
	bool applyFilter(QAction*, MeshDocument& document, const RichParameterList& list,
	                 vcg::CallBackPos* progress) override;
};
