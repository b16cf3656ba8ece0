#pragma once
// The view that the user sees, taken from MeshLab's window while a filter runs or its dialog opens.
//
// MeshLab's plugin interface has no call for it. Its parameter widgets ask the 3D window (class GLArea) through a slot and
// get the answer through a signal; any object may do the same, by name.

#include "camera_xml.h"

#include <optional>

namespace textlabel {

/// The current view of MeshLab's 3D window, nothing when there is none (meshlabserver, PyMeshLab).
/// With several views the one that was clicked last in the active document counts.
std::optional<Camera> CurrentView();

/// True when there is a window to take a view from.
bool HasWindow();

}  // namespace textlabel
