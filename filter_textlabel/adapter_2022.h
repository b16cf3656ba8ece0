#pragma once
// The plugin for MeshLab 2022.02 to 2025.07 and for PyMeshLab.

#include <common/plugins/interfaces/filter_plugin.h>

class TextLabelPlugin : public QObject, public FilterPlugin {
	Q_OBJECT
	MESHLAB_PLUGIN_IID_EXPORTER(FILTER_PLUGIN_IID)
	Q_INTERFACES(FilterPlugin)

public:
	TextLabelPlugin();
	QString pluginName() const override;
	QString vendor() const override;
	QString filterName(ActionIDType) const override;
	QString pythonFilterName(ActionIDType) const override;
	QString filterInfo(ActionIDType) const override;
	FilterClass getClass(const QAction*) const override;
	FilterArity filterArity(const QAction*) const override;
	int postCondition(const QAction*) const override;
	RichParameterList initParameterList(const QAction*, const MeshModel& model) override;
	std::map<std::string, QVariant> applyFilter(const QAction*, const RichParameterList& list, MeshDocument& document,
	                                            unsigned int& postConditionMask, vcg::CallBackPos* progress) override;
};
