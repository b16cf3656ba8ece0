#pragma once
// Pictures of plane figures, for the person who looks at a test that failed.

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vcg/space/point2.h>
#include <vector>

namespace svg {

/// A drawing in mathematical orientation (y up), scaled to a fixed width when it is written.
class Picture {
public:
	using Points = std::vector<vcg::Point2d>;

	/// A filled region; every further ring is a hole.
	void fill(const std::vector<Points>& rings, const std::string& color)
	{
		body_ << "<path fill=\"" << color << "\" fill-rule=\"evenodd\" d=\"";
		for (const Points& ring : rings) path(ring, true);
		body_ << "\"/>\n";
	}
	void line(const Points& points, const std::string& color, bool closed = false)
	{
		body_ << "<path fill=\"none\" vector-effect=\"non-scaling-stroke\" stroke=\"" << color << "\" d=\"";
		path(points, closed);
		body_ << "\"/>\n";
	}
	void label(const vcg::Point2d& p, const std::string& text) { labels_.push_back({p, text}); }

	void write(const std::string& file) const
	{
		constexpr double width = 800, margin = 20;  // pixels
		const double extent = std::max({high_[0] - low_[0], high_[1] - low_[1], std::numeric_limits<double>::min()});
		const double scale = width / extent;
		std::ofstream out(file);
		out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width + 2 * margin << "\" height=\""
			<< width + 2 * margin << "\">\n<g transform=\"translate(" << margin << ' ' << width + margin << ") scale("
			<< scale << ' ' << -scale << ") translate(" << -low_[0] << ' ' << -low_[1] << ")\">\n"
			<< body_.str() << "</g>\n";
		for (const Label& l : labels_)
			out << "<text font-size=\"12\" x=\"" << margin + (l.place[0] - low_[0]) * scale << "\" y=\""
				<< width + margin - (l.place[1] - low_[1]) * scale << "\">" << l.text << "</text>\n";
		out << "</svg>\n";
	}

private:
	struct Label {
		vcg::Point2d place;
		std::string text;
	};

	void path(const Points& points, bool closed)
	{
		body_.precision(std::numeric_limits<double>::max_digits10);
		for (size_t i = 0; i < points.size(); ++i) {
			body_ << (i == 0 ? 'M' : 'L') << points[i][0] << ' ' << points[i][1];
			for (int k = 0; k < 2; ++k) {
				low_[k] = std::min(low_[k], points[i][k]);
				high_[k] = std::max(high_[k], points[i][k]);
			}
		}
		if (closed) body_ << 'Z';
	}

	std::ostringstream body_;
	std::vector<Label> labels_;
	vcg::Point2d low_{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
	vcg::Point2d high_{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};
};

}  // namespace svg
