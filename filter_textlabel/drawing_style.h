#pragma once
// SVG's properties, as far as they decide where there is ink: from attributes, style attributes and style sheets.
//
// Colours do not matter, but for white: it covers what was painted before. Of style sheets those rules count whose selectors are
// elements, classes and ids, as drawing programs write them; other ones are passed over.
// Source: W3C, SVG 1.1, chapters 6 (styling), 7.6 (transform) and 11 (painting).

#include <optional>
#include <string>
#include <vector>
#include "drawing_shape.h"
#include "drawing_tree.h"

namespace textlabel {

/// From this opacity on white covers what is below it; less of it is but a gleam.
constexpr double kCovering = 0.5;

enum class Paint { None, Ink, White };

struct DrawnStyle {
	// handed down to the elements within
	Paint fill = Paint::Ink, stroke = Paint::None;
	Paint color = Paint::Ink;  ///< what currentColor means
	double fillOpacity = 1, strokeOpacity = 1;
	FillRule fillRule = FillRule::NonZero, clipRule = FillRule::NonZero;
	LineStyle line;
	std::string lineWidth = "1";  ///< as a length
	bool isVisible = true;
	bool isDashed = false, hasMarkers = false;
	// of one element
	bool isDisplayed = true;
	double opacity = 1;
	bool keepsLineWidth = false;  ///< whatever the transformation
	bool mayOverflow = false;     ///< of a drawing within the drawing: what is beside its rectangle is seen
	std::string clip, mask, transform;
	bool hasOrigin = false;  ///< the transformation is about another point than the origin

	/// The style that an element within begins with.
	DrawnStyle inherited() const;
};

/// The rules of a drawing's style elements, and all that else gives an element its style.
class StyleSheet {
public:
	/// Take all style elements of a tree.
	explicit StyleSheet(const SvgNode& root);
	std::size_t size() const { return m_rules.size(); }
	/// Bring an element's own properties to what it has inherited.
	void apply(const SvgNode& node, DrawnStyle& style) const;

private:
	using Declarations = std::vector<std::pair<std::string, std::string>>;
	/// What an element must be for a rule to count.
	struct Selector {
		std::string element, id;  ///< empty: any
		std::vector<std::string> classes;

		bool matches(const SvgNode& node, const std::vector<std::string>& classesOfNode) const;
		int weight() const;
	};
	struct Rule {
		Selector selector;
		Declarations declarations;
	};
	void collect(const SvgNode& node);
	void parse(const std::string& css);
	static Declarations ParseDeclarations(const std::string& text);
	static std::optional<Selector> ParseSelector(const std::string& text);

	std::vector<Rule> m_rules;  ///< what comes later weighs more
};

/// A length in user units.
/// @param[in] whole  what 100 % of it is
/// @return nothing for what is no length
std::optional<double> ParseLength(const std::string& text, double whole);

/// A list of transformations.
/// @return nothing for what is none
std::optional<Affine> ParseTransform(const std::string& text);

/// The id of "url(#id)"; empty when it is none.
std::string ReferenceOf(const std::string& value);

}  // namespace textlabel
