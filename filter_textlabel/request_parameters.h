#pragma once
// The parameter table as MeshLab's parameter list, and back. Class names differ between MeshLab's generations; nothing else does.

#include "label_request.h"
#include "meshlab_api.h"

namespace textlabel {

/// Append every parameter, with the request's values as defaults.
void AddParameters(const LabelRequest& request, RichParameterList& list);

/// The request that a list holds.
/// @throws RequestError{UnknownParameter} when the list lacks a parameter, RequestError{UnreadableValue} when its type is wrong
LabelRequest ReadParameters(const RichParameterList& list);

/// Put a request's value of one parameter into a list that has it.
void StoreParameter(const LabelRequest& request, const char* name, RichParameterList& list);

}  // namespace textlabel
