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

/// What a host offers.
struct FilterHost {
	std::function<void(const std::string&)> log;  ///< takes one message
	/// May be null: told the request once more where it was for the view in the window, with the camera that was found there.
	std::function<void(const LabelRequest& used)> noteUsedView{};
};

struct FilterOutcome {
	bool ok = false;
	std::string message;  ///< why not: what, where, remedy
	LabelReport report;   ///< when ok
};

/// Label the current layer. Every exception ends here: one that left a filter would end MeshLab. The report, and a refusal, go to
/// the log and to stderr.
/// @post not ok: the layer is as it was. Only where a file could not be written, which the message says, it is wholly labelled; and
///       in a window, which must show that, this is ok
FilterOutcome ApplyFilter(MeshDocument& document, const RichParameterList& list, vcg::CallBackPos* progress,
                          const FilterHost& host) noexcept;

}  // namespace textlabel
