#include "adapter_2022.h"
#include "filter_script.h"
#include "label_filter.h"

namespace {

Point3m Point(const vcg::Point3d& p) { return {Scalarm(p[0]), Scalarm(p[1]), Scalarm(p[2])}; }

std::map<std::string, QVariant> Outputs(const textlabel::LabelReport& r)
{
	std::map<std::string, QVariant> outputs{
		{"triangles_added", r.after.triangles - r.before.triangles},
		{"label_area", r.labelArea},
		{"volume_before", r.before.volume},
		{"volume_after", r.after.volume},
		{"anchor", QVariant::fromValue(Point(r.view.anchor))},
		{"normal", QVariant::fromValue(Point(r.view.direction))},
		{"wrap_radius", r.view.wrapRadius},
		{"wrap_axis", QVariant::fromValue(Point(r.view.wrapAxis))},
		{"size", r.size},
		{"module", r.module},
		{"depth", r.depth},
		{"stretch", r.stretch},
		{"least_stretch", r.leastStretch},
		{"surface_area", r.surfaceArea},
		{"thinnest_stroke", r.thinnestStroke},
		{"narrowest_gap", r.narrowestGap},
		{"coordinate_step", r.coordinateStep},
		{"survives_float32", r.survivesFloat32},
		{"milliseconds", r.milliseconds.back().second},
	};
	if (r.after.hasTopology) {
		outputs["border_edges"] = r.after.borderEdges;
		outputs["non_manifold_edges"] = r.after.nonManifoldEdges;
		outputs["components"] = r.after.components;
		if (r.after.genus) outputs["genus"] = *r.after.genus;
	}
	return outputs;
}

}  // namespace

TextLabelPlugin::TextLabelPlugin()
{
	typeList = {0};
	actionList.push_back(new QAction(filterName(0), this));
}

QString TextLabelPlugin::pluginName() const { return "FilterTextLabel"; }
QString TextLabelPlugin::vendor() const { return "TextLabel"; }
QString TextLabelPlugin::filterName(ActionIDType) const { return textlabel::FilterTitle(); }
QString TextLabelPlugin::pythonFilterName(ActionIDType) const { return textlabel::pythonName; }
QString TextLabelPlugin::filterInfo(ActionIDType) const { return textlabel::FilterDescription(); }
FilterPlugin::FilterClass TextLabelPlugin::getClass(const QAction*) const { return Remeshing; }
FilterPlugin::FilterArity TextLabelPlugin::filterArity(const QAction*) const { return SINGLE_MESH; }
int TextLabelPlugin::postCondition(const QAction*) const { return textlabel::FilterPostCondition(); }

RichParameterList TextLabelPlugin::initParameterList(const QAction*, const MeshModel& model)
{
	RichParameterList list;
	textlabel::AddFilterParameters(model, list);
	return list;
}

std::map<std::string, QVariant> TextLabelPlugin::applyFilter(const QAction*, const RichParameterList& list,
                                                             MeshDocument& document, unsigned int&,
                                                             vcg::CallBackPos* progress)
{
	const auto outcome =
		textlabel::ApplyFilter(document, list, progress, {[this](const std::string& message) { log(message); }});
	if (!outcome.ok) throw MLException(QString::fromStdString(outcome.message));
	return Outputs(outcome.report);
}

MESHLAB_PLUGIN_NAME_EXPORTER(TextLabelPlugin)
