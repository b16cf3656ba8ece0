#pragma once
// An SVG file as a tree of elements, by Expat.

#include <map>
#include <string>
#include <vector>

namespace textlabel {

/// An element of a drawing.
struct SvgNode {
	std::string name;                               ///< empty: it belongs to another language than SVG
	std::map<std::string, std::string> attributes;  ///< SVG's own, and XLink's, both by their plain names
	std::vector<SvgNode> children;
	std::string text;  ///< the characters in it, those of its children left out
	int line = 0;      ///< of the file, from 1

	/// The value of an attribute; empty when it is not there.
	const std::string& operator[](const char* attribute) const;
};

/// Read a file's bytes. External entities are not read.
/// @throws TextError{DrawingUnreadable}
SvgNode ParseSvg(const std::string& bytes);

}  // namespace textlabel
