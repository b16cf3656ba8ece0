#pragma once
// The filter as every generation of MeshLab sees it: parameters in, a labelled layer and a message out. What differs between the
// generations is in the adapters, which hold no logic.

#include "label_report.h"
#include "meshlab_api.h"

#include <QString>
#include <functional>
#include <wrap/callback.h>

namespace textlabel {

/// Name and description for menus and dialogs; HTML.
QString FilterTitle();
QString FilterDescription();

/// What the filter changes (MeshLab's mask of a post-condition).
int FilterPostCondition();

/// The parameters with defaults for a layer: numbers to start from when there is a window, else "chosen to fit".
/// @param[in] model  only looked at when there is a window
void AddFilterParameters(const MeshModel& model, RichParameterList& list);

struct FilterOutcome {
	bool ok = false;
	std::string message;  ///< why not: what, where, remedy
	LabelReport report;   ///< when ok
};

/// Label the current layer. Every exception ends here: one that left a filter would end MeshLab.
/// @param[in] log  takes one message; the report, and a refusal, go there and to stderr
/// @post not ok: the layer is as it was; or wholly labelled, when only a file could not be written, which the message says
FilterOutcome ApplyFilter(MeshDocument& document, const RichParameterList& list, vcg::CallBackPos* progress,
                          const std::function<void(const std::string&)>& log) noexcept;

}  // namespace textlabel
