#include "adapter_2020.h"
#include "label_filter.h"
#include "request_parameters.h"

namespace {

/// MeshLab notes a filter's parameters before it runs. They ask for the view in the window; the note gets the camera that was found
/// there: a saved script then makes the same label.
void NoteUsedView(MeshDocument& document, const textlabel::LabelRequest& used)
{
	if (!document.filterHistory || document.filterHistory->isEmpty()) return;
	FilterNameParameterValuesPair& last = document.filterHistory->last();
	if (last.first != textlabel::FilterTitle() || !last.second.hasParameter("camera")) return;
	textlabel::StoreParameter(used, "placement", last.second);
	textlabel::StoreParameter(used, "camera", last.second);
}

}  // namespace

TextLabelPlugin::TextLabelPlugin()
{
	typeList << 0;
	actionList << new QAction(filterName(0), this);
}

QString TextLabelPlugin::pluginName() const { return "FilterTextLabel"; }
QString TextLabelPlugin::filterName(FilterIDType) const { return textlabel::FilterTitle(); }
QString TextLabelPlugin::filterInfo(FilterIDType) const { return textlabel::FilterDescription(); }
MeshFilterInterface::FilterClass TextLabelPlugin::getClass(QAction*) { return Remeshing; }
MeshFilterInterface::FILTER_ARITY TextLabelPlugin::filterArity(QAction*) const { return SINGLE_MESH; }
int TextLabelPlugin::postCondition(QAction*) const { return textlabel::FilterPostCondition(); }

void TextLabelPlugin::initParameterSet(QAction*, MeshModel& model, RichParameterList& list)
{
	textlabel::AddFilterParameters(model, list);
}

bool TextLabelPlugin::applyFilter(QAction*, MeshDocument& document, const RichParameterList& list,
                                  vcg::CallBackPos* progress)
{
	textlabel::FilterHost host;
	host.log = [this](const std::string& message) { Log(message); };
	host.noteUsedView = [&document](const textlabel::LabelRequest& used) { NoteUsedView(document, used); };
	const auto outcome = textlabel::ApplyFilter(document, list, progress, host);
	errorMessage = QString::fromStdString(outcome.message);
	return outcome.ok;
}

MESHLAB_PLUGIN_NAME_EXPORTER(TextLabelPlugin)
