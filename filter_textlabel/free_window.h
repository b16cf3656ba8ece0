#pragma once
// Free windows: where in a depth image is the largest place of the text's shape without a step, a hole or a steep slope?

#include "depth_image.h"
#include <cstdint>
#include <optional>

namespace textlabel {

/// What a label may lie on.
struct Smoothness {
	double maxSlope = 0;  ///< tangent of the steepest slope against the look
	double maxStep = 0;   ///< unexplained step between neighbours, pixels per pixel
	bool trustNormals =
		true;  ///< judge the slope by the faces; without, by the depths alone (needles have wild normals)
};

/// Which pixels a label may cover, with sums that answer for any window in constant time.
class FreeArea {
public:
	FreeArea(int width, int height) : width_(width), height_(height), free_(size_t(width) * size_t(height), 1) {}
	int width() const { return width_; }
	int height() const { return height_; }
	bool isFree(int x, int y) const { return free_[index(x, y)] != 0; }
	void block(int x, int y) { free_[index(x, y)] = 0; }
	/// To be called after the last block() and before the first isWindowFree().
	void sumUp();
	/// Are all pixels from (x0, y0) to (x1, y1), both included, inside the image and free?
	bool isWindowFree(int x0, int y0, int x1, int y1) const;

private:
	size_t index(int x, int y) const { return size_t(y) * size_t(width_) + size_t(x); }
	size_t sumIndex(int x, int y) const { return size_t(y) * size_t(width_ + 1) + size_t(x); }
	int width_, height_;
	std::vector<std::uint8_t> free_;
	std::vector<int> blockedBefore_;  ///< blocked pixels left of x and below y, (width+1) by (height+1)
};

inline void FreeArea::sumUp()
{
	blockedBefore_.assign(size_t(width_ + 1) * size_t(height_ + 1), 0);
	for (int y = 0; y < height_; ++y)
		for (int x = 0, inRow = 0; x < width_; ++x) {
			inRow += isFree(x, y) ? 0 : 1;
			blockedBefore_[sumIndex(x + 1, y + 1)] = blockedBefore_[sumIndex(x + 1, y)] + inRow;
		}
}

inline bool FreeArea::isWindowFree(int x0, int y0, int x1, int y1) const
{
	if (x0 < 0 || y0 < 0 || x1 >= width_ || y1 >= height_) return false;
	return blockedBefore_[sumIndex(x1 + 1, y1 + 1)] - blockedBefore_[sumIndex(x0, y1 + 1)] -
	           blockedBefore_[sumIndex(x1 + 1, y0)] + blockedBefore_[sumIndex(x0, y0)] ==
	       0;
}

namespace detail {

/// Slope of the seen face in pixels of depth per pixel to the right and up; not finite for a face seen edge-on.
inline std::array<double, 2> FaceSlope(const Part& part, const DepthImage& image, size_t at)
{
	const vcg::Point3d& area = part.areas[size_t(image.face[at])];
	const double facing = area * image.axes.towards;
	return {-(area * image.axes.right) / facing, -(area * image.axes.up) / facing};
}

/// May a label go on from pixel a to its neighbour b (axis 0: right, 1: up)? The step must be explained by their slopes, and their
/// colour be the same: another one may be an earlier label's.
inline bool GoesOn(const Part& part, const DepthImage& image, size_t a, size_t b, size_t axis, const Smoothness& rule)
{
	if (!part.paint.empty() && part.paint[size_t(image.face[a])] != part.paint[size_t(image.face[b])]) return false;
	if (image.face[a] == image.face[b] && rule.trustNormals) return true;
	const double step = (image.depth[b] - image.depth[a]) / image.grid.pixel;
	if (!rule.trustNormals) return std::abs(step) <= rule.maxStep;
	const double slopeA = FaceSlope(part, image, a)[axis], slopeB = FaceSlope(part, image, b)[axis];
	return step >= std::min(slopeA, slopeB) - rule.maxStep && step <= std::max(slopeA, slopeB) + rule.maxStep;
}

/// Does the pixel show the front of a face that is not too steep?
inline bool IsLabelable(const Part& part, const DepthImage& image, size_t at, const Smoothness& rule)
{
	if (image.face[at] < 0) return false;
	if (!(part.areas[size_t(image.face[at])] * image.axes.towards > 0)) return false;
	if (!rule.trustNormals) return true;
	const std::array<double, 2> slope = FaceSlope(part, image, at);
	return std::hypot(slope[0], slope[1]) <= rule.maxSlope;
}

}  // namespace detail

/// The pixels that a label may cover: both sides of a step are blocked, so a free window never spans one.
inline FreeArea FindFreeArea(const Part& part, const DepthImage& image, const Smoothness& rule)
{
	const int width = image.grid.width, height = image.grid.height;
	FreeArea area(width, height);
	for (int y = 0; y < height; ++y)
		for (int x = 0; x < width; ++x)
			if (!detail::IsLabelable(part, image, image.grid.at(x, y), rule)) area.block(x, y);
	const FreeArea labelable = area;
	const auto separate = [&](int x0, int y0, int x1, int y1, size_t axis) {
		if (!labelable.isFree(x0, y0) || !labelable.isFree(x1, y1)) return;
		if (detail::GoesOn(part, image, image.grid.at(x0, y0), image.grid.at(x1, y1), axis, rule)) return;
		area.block(x0, y0);
		area.block(x1, y1);
	};
	for (int y = 0; y < height; ++y)
		for (int x = 0; x < width; ++x) {
			if (x + 1 < width) separate(x, y, x + 1, y, 0);
			if (y + 1 < height) separate(x, y, x, y + 1, 1);
		}
	area.sumUp();
	return area;
}

/// A window of the text's shape: centre and scale in pixels (its sides are scale * shape).
struct FreeWindow {
	int x = 0, y = 0;
	double scale = 0;
};

namespace detail {

/// Number of pixels that a window reaches to each side of its central pixel.
inline int Reach(double side) { return int(std::floor(side / 2 + 0.5)); }

inline bool Fits(const FreeArea& area, int x, int y, double width, double height)
{
	const int dx = Reach(width), dy = Reach(height);
	return area.isWindowFree(x - dx, y - dy, x + dx, y + dy);
}

/// Groups of 4-connected pixels out of `inside`; returns the largest group (the first of equals, from the bottom left).
inline std::vector<size_t> LargestGroup(std::vector<std::uint8_t> inside, int width, int height)
{
	std::vector<size_t> largest, group;
	for (size_t seed = 0; seed < inside.size(); ++seed) {
		if (!inside[seed]) continue;
		inside[seed] = 0;
		group.assign(1, seed);
		for (size_t i = 0; i < group.size(); ++i) {
			const int x = int(group[i] % size_t(width)), y = int(group[i] / size_t(width));
			const auto join = [&](bool exists, size_t at) {
				if (!exists || !inside[at]) return;
				inside[at] = 0;
				group.push_back(at);
			};
			join(x > 0, group[i] - 1);
			join(x + 1 < width, group[i] + 1);
			join(y > 0, group[i] - size_t(width));
			join(y + 1 < height, group[i] + size_t(width));
		}
		if (group.size() > largest.size()) largest.swap(group);
	}
	return largest;
}

/// The pixel of a group that is nearest to the group's centre of gravity.
inline size_t MiddleOf(const std::vector<size_t>& group, size_t width)
{
	double sumX = 0, sumY = 0;
	for (size_t at : group) {
		sumX += double(at % width);
		sumY += double(at / width);
	}
	const double middleX = sumX / double(group.size()), middleY = sumY / double(group.size());
	const auto distance = [&](size_t at) {
		return std::hypot(double(at % width) - middleX, double(at / width) - middleY);
	};
	return *std::min_element(group.begin(), group.end(), [&](size_t a, size_t b) { return distance(a) < distance(b); });
}

}  // namespace detail

/// The largest free window of a shape, in the middle of where it (or one nearly as large) can slide.
/// @param[in] slack     share of the largest scale that is given up to be centred, e.g. 0.03; at least a pixel
/// @param[in] minScale  smaller windows do not count
inline std::optional<FreeWindow> LargestFreeWindow(const FreeArea& area, double shapeWidth, double shapeHeight,
                                                   double slack, double minScale)
{
	const double grow = 1 / std::max(shapeWidth, shapeHeight);  // one pixel more of the longer side
	const auto fits = [&](int x, int y, double scale) {
		return detail::Fits(area, x, y, scale * shapeWidth, scale * shapeHeight);
	};
	double scale = minScale;
	bool found = false;
	for (int y = 0; y < area.height(); ++y)
		for (int x = 0; x < area.width(); ++x) {
			if (!found && fits(x, y, scale)) found = true;
			while (found && fits(x, y, scale + grow)) scale += grow;
		}
	if (!found) return std::nullopt;
	const double pixel = 1 / std::min(shapeWidth, shapeHeight);  // what the image cannot tell
	scale = std::max(minScale, std::min(scale * (1 - slack), scale - pixel));
	std::vector<std::uint8_t> possible(size_t(area.width()) * size_t(area.height()), 0);
	for (int y = 0; y < area.height(); ++y)
		for (int x = 0; x < area.width(); ++x)
			possible[size_t(y) * size_t(area.width()) + size_t(x)] = fits(x, y, scale) ? 1 : 0;
	const size_t at =
		detail::MiddleOf(detail::LargestGroup(std::move(possible), area.width(), area.height()), size_t(area.width()));
	return FreeWindow{int(at % size_t(area.width())), int(at / size_t(area.width())), scale};
}

}  // namespace textlabel
