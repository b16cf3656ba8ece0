// The picture of a flat label (text_outline.h).

#include <algorithm>
#include <iomanip>
#include <locale>
#include <sstream>
#include "text_outline.h"

namespace textlabel {

std::string OutlineToSvg(const TextOutline& text)
{
	constexpr double kMargin = 0.1;  // times the capital height
	constexpr int kDigits = 9;       // more than a picture or a cutter resolves
	const double margin = kMargin * text.capitalHeight;
	const double x = text.boxMin[0] - margin, y = -text.boxMax[1] - margin;  // SVG's y points down
	const double width = text.boxMax[0] - text.boxMin[0] + 2 * margin;
	const double height = text.boxMax[1] - text.boxMin[1] + 2 * margin;
	std::ostringstream svg;
	svg.imbue(std::locale::classic());
	svg << std::setprecision(kDigits);
	svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "mm\" height=\"" << height
		<< "mm\" viewBox=\"" << x << ' ' << y << ' ' << width << ' ' << height << "\">\n"
		<< "<rect x=\"" << x << "\" y=\"" << y << "\" width=\"" << width << "\" height=\"" << height
		<< "\" fill=\"white\"/>\n<path fill=\"black\" fill-rule=\"evenodd\" d=\"";
	for (const vcg::textlabel::Contour& contour : text.outline.contours) {
		char command = 'M';
		for (const vcg::Point2d& p : contour.points) {
			svg << command << p[0] << ' ' << -p[1];
			command = 'L';
		}
		svg << "Z\n";
	}
	svg << "\"/>\n</svg>\n";
	return svg.str();
}

}  // namespace textlabel
