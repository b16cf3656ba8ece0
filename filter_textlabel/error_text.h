#pragma once
// Every refusal as a sentence for a person: what is wrong, where, and what to do about it, with the numbers.

#include "request_error.h"
#include "text_error.h"
#include "vcg_ext/label_error.h"

#include <string>
#include <vector>

namespace textlabel {

/// What a sentence needs beside the error.
struct ErrorContext {
	std::vector<std::string> letters;  ///< UTF-8, index = Error::letter
	double depth = 0;                  ///< signed height that was tried, world units
	bool isMade = false;               ///< the label is in the mesh: what failed came after it
	int fileDigits = 0;                ///< LabelOptions::fileDigits
	bool isWrapped = false;            ///< round an axis
	bool isAlongView = false;          ///< it is extruded along the viewpoint
};

/// "The letter 'B' runs over a border of the surface near (1, 2, 3). Move the label, or ..."
std::string ErrorText(const vcg::textlabel::Error& error, const ErrorContext& context = {});
std::string ErrorText(const TextError& error);
std::string ErrorText(const RequestError& error);

/// True when another place or a smaller label may succeed where this one was refused.
bool DependsOnPlace(vcg::textlabel::ErrorCode code);

/// A number for a person: six significant digits.
std::string Figure(double value);

}  // namespace textlabel
