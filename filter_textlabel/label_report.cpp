#include "label_report.h"

#include <cmath>

namespace textlabel {
namespace {

std::string Json(double value)
{
	return std::isfinite(value) ? NumberText(value) : "null";  // JSON knows no infinity
}

std::string Json(int value) { return std::to_string(value); }
std::string Json(std::optional<int> value) { return value ? Json(*value) : "null"; }
std::string Json(bool value) { return value ? "true" : "false"; }
std::string Json(const vcg::Point3d& p) { return "[" + Json(p[0]) + "," + Json(p[1]) + "," + Json(p[2]) + "]"; }

std::string Json(const std::string& text)
{
	static const char* const digits = "0123456789abcdef";
	std::string quoted = "\"";
	for (const char c : text) {
		const auto byte = static_cast<unsigned char>(c);
		if (c == '"' || c == '\\') quoted += {'\\', c};
		else if (c == '\n') quoted += "\\n";
		else if (byte < 0x20) quoted += {'\\', 'u', '0', '0', digits[byte / 16], digits[byte % 16]};
		else quoted += c;
	}
	return quoted + '"';
}

/// Members of an object, in order.
class Object {
public:
	template <class Value>
	Object& add(const std::string& name, const Value& value)
	{
		return addRaw(name, Json(value));
	}
	Object& addRaw(const std::string& name, const std::string& json)
	{
		text_ += (text_.empty() ? "{" : ",") + Json(name) + ":" + json;
		return *this;
	}
	std::string str() const { return text_.empty() ? "{}" : text_ + "}"; }

private:
	std::string text_;
};

std::string View(const UsedView& view)
{
	Object object;
	object.add("direction", view.direction).add("up", view.up).add("perspective", view.perspective);
	if (view.perspective) object.add("viewpoint", view.viewpoint);
	if (view.wrapRadius != 0) object.add("wrap_radius", view.wrapRadius).add("wrap_axis", view.wrapAxis);
	return object.str();
}

template <class Member>
void AddBeforeAfter(Object& object, const std::string& name, const MeshNumbers& before, const MeshNumbers& after,
                    Member member)
{
	const auto number = [&](const MeshNumbers& mesh) {
		return mesh.hasTopology ? Json(mesh.*member) : std::string("null");
	};
	object.addRaw(name + "_before", number(before)).addRaw(name + "_after", number(after));
}

}  // namespace

std::string ReportJson(const LabelReport& r)
{
	Object json;
	const bool isDrawing = !r.request.drawing.empty();  // then the text was not read
	json.add("text", isDrawing ? "" : r.request.text)
		.add("code", ChoiceNames(r.request.code)[size_t(r.request.code)])
		.add("module", r.module)
		.add("drawing", r.request.drawing)
		.add("font", r.font)
		.add("style", ChoiceNames(r.request.style)[size_t(r.request.style)]);
	json.add("placement", ChoiceNames(r.request.placement)[size_t(r.request.placement)]);
	json.add("size", r.size).add("depth", r.depth);
	json.add("triangles_before", r.before.triangles).add("triangles_after", r.after.triangles);
	json.add("vertices_before", r.before.vertices).add("vertices_after", r.after.vertices);
	json.add("triangles_touched", r.touchedTriangles).add("label_area", r.labelArea).add("surface_area", r.surfaceArea);
	json.add("volume_before", r.before.volume).add("volume_after", r.after.volume);
	AddBeforeAfter(json, "border_edges", r.before, r.after, &MeshNumbers::borderEdges);
	AddBeforeAfter(json, "non_manifold_edges", r.before, r.after, &MeshNumbers::nonManifoldEdges);
	AddBeforeAfter(json, "components", r.before, r.after, &MeshNumbers::components);
	AddBeforeAfter(json, "genus", r.before, r.after, &MeshNumbers::genus);
	json.add("stretch", r.stretch);
	if (r.view.wrapRadius != 0) json.add("least_stretch", r.leastStretch);
	json.add("resolution", r.resolution)
		.add("coordinate_step", r.coordinateStep)
		.add("survives_float32", r.survivesFloat32);
	json.add("thinnest_stroke", r.thinnestStroke).add("narrowest_gap", r.narrowestGap);
	json.add("anchor", r.view.anchor).addRaw("camera", View(r.view));
	Object times;
	for (const auto& [stage, time] : r.milliseconds) times.add(stage, std::round(time * 1000) / 1000);
	json.addRaw("milliseconds", times.str());
	return json.str();
}

}  // namespace textlabel
