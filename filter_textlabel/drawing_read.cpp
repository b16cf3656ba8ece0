#include "drawing_read.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include "drawing_path.h"
#include "drawing_scan.h"
#include "drawing_style.h"
#include "text_error.h"
#include "text_file.h"

namespace textlabel {
namespace {

using vcg::Point2d;

/// Elements that are drawn, those that are used again counted again, and the rules that all of them are held against.
constexpr std::size_t kMostDrawn = 200000, kMostStyled = 200000000;
/// How deeply elements may use others.
constexpr int kMostDepth = 250;
/// Curves of all that is drawn.
constexpr std::size_t kMostCurves = 1000000;
/// Coordinates of a page that is no longer one.
constexpr double kFarthest = 1e12;
/// Where lengths in percent refer to nothing.
constexpr double kDefaultWidth = 300, kDefaultHeight = 150;

struct Rectangle {
	double x = 0, y = 0, width = kDefaultWidth, height = kDefaultHeight;
};

class DrawingReader {
public:
	explicit DrawingReader(const SvgNode& root) : m_root(root), m_sheet(root) { collectIds(root); }

	Drawing run()
	{
		m_view = viewBoxOf(m_root).value_or(
			Rectangle{0, 0, across(m_root, "width", kDefaultWidth), down(m_root, "height", kDefaultHeight)});
		drawRoot();
		return std::move(m_drawing);
	}

private:
	/// What an element gets from those around it.
	struct Context {
		DrawnStyle style;
		Affine toPage;
		std::vector<int> clips;
		double opacity = 1;
		int depth = 0;
	};

	void collectIds(const SvgNode& node)
	{
		if (!node["id"].empty()) m_ids.emplace(node["id"], &node);
		for (const SvgNode& child : node.children) collectIds(child);
	}
	const SvgNode* find(const std::string& id) const
	{
		const auto found = m_ids.find(id);
		return found == m_ids.end() ? nullptr : found->second;
	}

	[[noreturn]] static void unsupported(const SvgNode& node, const char* what)
	{
		throw TextError(TextErrorCode::DrawingUnsupported, what).measured(node.line, 0);
	}
	[[noreturn]] static void unreadable(const SvgNode& node, const std::string& what)
	{
		throw TextError(TextErrorCode::DrawingUnreadable, what + " on line " + std::to_string(node.line));
	}

	double length(const SvgNode& node, const char* attribute, double whole, double otherwise = 0) const
	{
		const std::string& text = node[attribute];
		if (text.empty() || text == "auto") return otherwise;
		const auto value = ParseLength(text, whole);
		if (!value) unreadable(node, std::string("the ") + attribute + " is no length");
		return *value;
	}
	double across(const SvgNode& node, const char* attribute, double otherwise = 0) const
	{
		return length(node, attribute, m_view.width, otherwise);
	}
	double down(const SvgNode& node, const char* attribute, double otherwise = 0) const
	{
		return length(node, attribute, m_view.height, otherwise);
	}
	/// Of a radius or a line's width: the mean of both ways, as SVG has it.
	double diagonal() const { return std::hypot(m_view.width, m_view.height) / std::sqrt(2.0); }

	static std::optional<Rectangle> viewBoxOf(const SvgNode& node)
	{
		if (node["viewBox"].empty()) return std::nullopt;
		Scanner scanner(node["viewBox"]);
		double n[4];
		for (double& each : n) {
			const auto number = scanner.number();
			if (!number) unreadable(node, "the viewBox does not have four numbers");
			each = *number;
		}
		if (!(n[2] > 0) || !(n[3] > 0)) return std::nullopt;
		return Rectangle{n[0], n[1], n[2], n[3]};
	}

	/// From the coordinates of a viewBox to the rectangle that shows it.
	static Affine Shown(const Rectangle& box, const Rectangle& in, const std::string& aspect)
	{
		double sx = in.width / box.width, sy = in.height / box.height;
		if (aspect.find("none") == std::string::npos)
			sx = sy = aspect.find("slice") != std::string::npos ? std::max(sx, sy) : std::min(sx, sy);
		const auto share = [&](const char* low, const char* high) {
			return aspect.find(low) != std::string::npos ? 0.0 : aspect.find(high) != std::string::npos ? 1.0 : 0.5;
		};
		const double left = in.width - sx * box.width, above = in.height - sy * box.height;
		return {sx,
		        0,
		        0,
		        sy,
		        in.x + left * share("xMin", "xMax") - sx * box.x,
		        in.y + above * share("YMin", "YMax") - sy * box.y};
	}

	/// How the root fits its page does not matter, but that it may stretch it. What is beside a page is not seen.
	void drawRoot()
	{
		Context context;
		const auto isSized = [&](const char* side) { return !m_root[side].empty() && m_root[side].back() != '%'; };
		const bool hasPage = !m_root["viewBox"].empty() || (isSized("width") && isSized("height"));
		const bool stretches = m_root["preserveAspectRatio"].find("none") != std::string::npos;
		const auto box = viewBoxOf(m_root);
		if (box && stretches)
			context.toPage =
				Shown(*box, {0, 0, across(m_root, "width", box->width), down(m_root, "height", box->height)}, "none");
		auto own = enter(m_root, context);
		if (!own) return;
		if (hasPage) own->clips.push_back(addWindow(m_view, own->toPage));
		drawChildren(m_root, *own);
	}

	/// A rectangle beside which nothing is seen.
	int addWindow(const Rectangle& r, const Affine& toPage)
	{
		DrawnShape shape;
		shape.paths.push_back(RectanglePath({r.x, r.y}, {r.width, r.height}, {0, 0}));
		shape.toPage = toPage;
		m_drawing.clips.push_back({shape});
		return static_cast<int>(m_drawing.clips.size()) - 1;
	}

	/// The context within an element; none when it is not shown.
	std::optional<Context> enter(const SvgNode& node, const Context& around)
	{
		++m_drawn;
		if (m_drawn > kMostDrawn || m_drawn * m_sheet.size() > kMostStyled)
			throw TextError(TextErrorCode::DrawingUnreadable, "it draws too many elements");
		if (around.depth == kMostDepth) unreadable(node, "an element uses itself");
		Context own{around.style.inherited(), around.toPage, around.clips, around.opacity, around.depth + 1};
		m_sheet.apply(node, own.style);
		own.opacity *= own.style.opacity;
		if (!own.style.isDisplayed || !(own.opacity > 0)) return std::nullopt;
		if (!own.style.transform.empty() && own.style.transform != "none") {
			const auto map = ParseTransform(own.style.transform);
			if (!map) unreadable(node, "the transform cannot be read");
			if (own.style.hasOrigin) unsupported(node, "a transform-origin");
			own.toPage = own.toPage.after(*map);
		}
		if (!ReferenceOf(own.style.mask).empty()) unsupported(node, "a mask");
		const std::string clip = ReferenceOf(own.style.clip);
		if (clip.empty() && !own.style.clip.empty() && own.style.clip != "none")
			unsupported(node, "a clip path that is no path");
		if (const SvgNode* const path = clip.empty() ? nullptr : find(clip)) own.clips.push_back(addClip(*path, own));
		return own;
	}

	/// The shapes of a clip path, in the coordinates of what it clips.
	int addClip(const SvgNode& path, const Context& of)
	{
		if (path["clipPathUnits"] == "objectBoundingBox") unsupported(path, "a clip path in shares of what it clips");
		Context context{{}, of.toPage, {}, 1, of.depth + 1};
		m_sheet.apply(path, context.style);
		if (!ReferenceOf(context.style.clip).empty()) unsupported(path, "a clip path that is clipped");
		if (const auto map = ParseTransform(context.style.transform)) context.toPage = context.toPage.after(*map);
		std::vector<DrawnShape> outside = std::exchange(m_drawing.shapes, {});
		const bool wasClip = std::exchange(m_isClip, true);
		drawChildren(path, context);
		m_isClip = wasClip;
		m_drawing.clips.push_back(std::exchange(m_drawing.shapes, std::move(outside)));
		return static_cast<int>(m_drawing.clips.size()) - 1;
	}

	void drawChildren(const SvgNode& node, const Context& context)
	{
		for (const SvgNode& child : node.children) draw(child, context);
	}

	void draw(const SvgNode& node, const Context& around)
	{
		const auto found = Drawers().find(node.name);
		if (found == Drawers().end()) return;
		if (const auto own = enter(node, around)) (this->*found->second)(node, *own);
	}

	using Drawer = void (DrawingReader::*)(const SvgNode&, const Context&);
	static const std::map<std::string, Drawer>& Drawers()
	{
		using R = DrawingReader;
		static const std::map<std::string, Drawer> table{
			{"g", &R::drawChildren},     {"a", &R::drawChildren},        {"svg", &R::drawNested},
			{"switch", &R::drawSwitch},  {"use", &R::drawUse},           {"path", &R::drawPath},
			{"rect", &R::drawRectangle}, {"circle", &R::drawEllipse},    {"ellipse", &R::drawEllipse},
			{"line", &R::drawLine},      {"polyline", &R::drawPolyline}, {"polygon", &R::drawPolyline},
			{"text", &R::drawText},      {"image", &R::drawImage}};
		return table;
	}

	void drawNested(const SvgNode& node, const Context& context)
	{
		drawViewed(node, context,
		           {across(node, "x"), down(node, "y"), across(node, "width", m_view.width),
		            down(node, "height", m_view.height)});
	}

	/// The children of an element that may have a viewBox, in a rectangle.
	void drawViewed(const SvgNode& node, Context context, const Rectangle& in)
	{
		if (!(in.width > 0) || !(in.height > 0)) return;
		const Rectangle box = viewBoxOf(node).value_or(Rectangle{0, 0, in.width, in.height});
		const Affine outside = context.toPage;
		context.toPage = outside.after(Shown(box, in, node["preserveAspectRatio"]));
		if (!context.style.mayOverflow) context.clips.push_back(addWindow(in, outside));
		const Rectangle outer = std::exchange(m_view, box);
		drawChildren(node, context);
		m_view = outer;
	}

	/// The first child that any reader knows.
	void drawSwitch(const SvgNode& node, const Context& context)
	{
		for (const SvgNode& child : node.children) {
			const bool isForSome = !child["requiredExtensions"].empty() || !child["requiredFeatures"].empty() ||
			                       !child["systemLanguage"].empty();
			if (isForSome || Drawers().count(child.name) == 0) continue;
			return draw(child, context);
		}
	}

	void drawUse(const SvgNode& node, const Context& around)
	{
		Context context = around;
		const std::string& href = node["href"];
		const SvgNode* const used = href.empty() || href[0] != '#' ? nullptr : find(href.substr(1));
		if (!used) unreadable(node, "nothing has the name '" + href + "', which is used");
		context.toPage = context.toPage.after({1, 0, 0, 1, across(node, "x"), down(node, "y")});
		if (used->name != "symbol" && used->name != "svg") return draw(*used, context);
		const auto own = enter(*used, context);
		if (!own) return;
		const Rectangle in{0, 0, across(node, "width", across(*used, "width", m_view.width)),
		                   down(node, "height", down(*used, "height", m_view.height))};
		drawViewed(*used, *own, in);
	}
	void drawPath(const SvgNode& node, const Context& context)
	{
		auto paths = ParsePath(node["d"]);
		if (!paths) unreadable(node, "the data of a path cannot be read");
		add(node, std::move(*paths), context);
	}
	void drawPolyline(const SvgNode& node, const Context& context)
	{
		auto paths = ParsePolyline(node["points"], node.name == "polygon");
		if (!paths) unreadable(node, "the points cannot be read");
		add(node, std::move(*paths), context);
	}
	void drawLine(const SvgNode& node, const Context& context)
	{
		const Point2d from(across(node, "x1"), down(node, "y1")), to(across(node, "x2"), down(node, "y2"));
		add(node, {{{CurvePiece::Line(from, to)}, false}}, context);
	}
	void drawRectangle(const SvgNode& node, const Context& context)
	{
		const Point2d size(across(node, "width"), down(node, "height"));
		if (!(size[0] > 0) || !(size[1] > 0)) return;
		const double rx = across(node, "rx", -1), ry = down(node, "ry", -1);  // one stands for both
		add(node, {RectanglePath({across(node, "x"), down(node, "y")}, size, {rx < 0 ? ry : rx, ry < 0 ? rx : ry})},
		    context);
	}
	void drawEllipse(const SvgNode& node, const Context& context)
	{
		const double r = length(node, "r", diagonal());
		const bool isCircle = node.name == "circle";
		const double rx = isCircle ? r : across(node, "rx", -1), ry = isCircle ? r : down(node, "ry", -1);
		const Point2d radii(rx < 0 ? ry : rx, ry < 0 ? rx : ry);
		if (!(radii[0] > 0) || !(radii[1] > 0)) return;
		add(node, {EllipsePath({across(node, "cx"), down(node, "cy")}, radii)}, context);
	}
	void drawText(const SvgNode& node, const Context& context)
	{
		const std::function<bool(const SvgNode&)> hasInk = [&](const SvgNode& each) {
			return !std::all_of(each.text.begin(), each.text.end(), Scanner::IsBlank) ||
			       std::any_of(each.children.begin(), each.children.end(), hasInk);
		};
		if (context.style.isVisible && hasInk(node)) unsupported(node, "text");
	}
	void drawImage(const SvgNode& node, const Context& context)
	{
		if (context.style.isVisible) unsupported(node, "a picture");
	}

	/// What a path paints: its filling, then its line.
	void add(const SvgNode& node, std::vector<DrawnPath> paths, const Context& context)
	{
		const DrawnStyle& style = context.style;
		if (!style.isVisible || paths.empty()) return;
		DrawnShape shape;
		shape.paths = std::move(paths);
		shape.toPage = context.toPage;
		shape.clips = context.clips;
		requireFinite(node, shape);
		for (const DrawnPath& path : shape.paths) m_curves += path.curves.size();
		if (m_curves > kMostCurves) throw TextError(TextErrorCode::DrawingUnreadable, "it draws too many curves");
		const Paint fill = m_isClip ? Paint::Ink : Seen(style.fill, context.opacity * style.fillOpacity);
		if (fill != Paint::None) {
			shape.rule = m_isClip ? style.clipRule : style.fillRule;
			shape.isWhite = fill == Paint::White;
			m_drawing.shapes.push_back(shape);
		}
		const Paint stroke = m_isClip ? Paint::None : Seen(style.stroke, context.opacity * style.strokeOpacity);
		if (stroke == Paint::None) return;
		shape.isLine = true;
		shape.isWhite = stroke == Paint::White;
		shape.line = style.line;
		const auto width = ParseLength(style.lineWidth, diagonal());
		if (!width) unreadable(node, "the stroke-width is no length");
		shape.line.width = *width;
		if (!(shape.line.width > 0)) return;
		if (style.isDashed) unsupported(node, "a dashed line");
		if (style.hasMarkers) unsupported(node, "a line with markers");
		if (style.keepsLineWidth) {
			for (DrawnPath& path : shape.paths) path.curves = Mapped({path.curves}, shape.toPage)[0];
			shape.toPage = Affine();
		}
		m_drawing.shapes.push_back(std::move(shape));
	}

	/// What is left of a paint that lets something through.
	static Paint Seen(Paint paint, double opacity)
	{
		return !(opacity > 0) || (paint == Paint::White && opacity < kCovering) ? Paint::None : paint;
	}

	static void requireFinite(const SvgNode& node, const DrawnShape& shape)
	{
		const auto isNear = [](const Point2d& p) { return std::abs(p[0]) < kFarthest && std::abs(p[1]) < kFarthest; };
		for (const DrawnPath& path : shape.paths)
			for (const CurvePiece& piece : path.curves)
				for (const Point2d& p : piece.p)
					if (!isNear(p) || !isNear(shape.toPage(p))) unreadable(node, "a coordinate is too large");
	}

	const SvgNode& m_root;
	const StyleSheet m_sheet;
	std::map<std::string, const SvgNode*> m_ids;
	Drawing m_drawing;
	Rectangle m_view;       ///< what lengths in percent refer to
	bool m_isClip = false;  ///< what is drawn is a clip path
	std::size_t m_drawn = 0;
	std::size_t m_curves = 0;
};

}  // namespace

Drawing ReadSvg(const std::string& bytes)
{
	const SvgNode root = ParseSvg(bytes);
	return DrawingReader(root).run();
}

Drawing ReadDrawing(const std::string& file)
{
	try {
		const FileBytes read = ReadWholeFile(file, kLargestDrawing);
		if (!read.bytes) throw TextError(TextErrorCode::DrawingUnreadable, read.why);
		return ReadSvg(*read.bytes);
	} catch (TextError& error) {
		error.ofDrawing(file);
		throw;
	}
}

}  // namespace textlabel
