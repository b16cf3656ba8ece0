#pragma once
// A request as text that a host runs: a MeshLab 2020.09 filter script (.mlx), or a call for PyMeshLab.

#include "label_request.h"

namespace textlabel {

constexpr const char* filterName = "Text Label";        ///< in menus and scripts
constexpr const char* pythonName = "apply_text_label";  ///< in PyMeshLab

/// A filter script for meshlabserver and for MeshLab's script dialog, with every parameter of the table: Debian's build
/// ends with an assert when one is missing.
/// @throws RequestError{UnreadableValue} when a text holds what XML cannot carry: a control character, or bytes that are no UTF-8
std::string ScriptText(const LabelRequest& request);

/// The same as one line of Python: ms.apply_filter('apply_text_label', text='A43', ...), without what is at its default.
std::string PythonCall(const LabelRequest& request);

}  // namespace textlabel
