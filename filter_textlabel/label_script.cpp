// textlabel_script NAME=VALUE...: print the filter script (.mlx) of a label, all parameters in it.
// textlabel_script --parameters: print what there is, for a person.
//
// label.sh runs it, so that names, types and defaults of the parameters stand in one table for scripts too.
// Exit 0, or 2 with a message on stderr when an argument is none.

#include "error_text.h"
#include "filter_script.h"

#include <iostream>
#include <set>
#include <stdexcept>

namespace {

using namespace textlabel;

/// @return the parameter's name
std::string Apply(const std::string& argument, LabelRequest& request)
{
	const size_t equals = argument.find('=');
	const std::string name = argument.substr(0, equals);
	const Parameter* const parameter = FindParameter(name);
	if (!parameter || equals == std::string::npos) throw RequestError(RequestProblem::UnknownParameter, name);
	SetValue(*parameter, request, argument.substr(equals + 1));
	return name;
}

/// What is given is meant to be used, as in Python (check_values in python/textlabel/plugin.py).
/// @throws std::invalid_argument when it says from where, but not where
void Imply(const std::set<std::string>& given, LabelRequest& request)
{
	const auto has = [&given](const char* name) { return given.count(name) > 0; };
	if (has("direction") && !has("position") && !has("placement"))
		throw std::invalid_argument(
			"A direction alone says no place. Give a position as well, a point of the surface, or leave the direction "
			"away: the place is chosen then.");
	if (!has("placement")) {
		if (has("camera")) request.placement = PlacementKind::Camera;
		else if (has("position")) request.placement = PlacementKind::PointAndDirection;
	}
	const bool isBlank = request.camera.find_first_not_of(" \t\r\n") == std::string::npos;
	if (has("camera") && isBlank && !has("position")) throw RequestError(RequestProblem::CameraMissing, "camera");
	if (has("color") && !has("tint")) request.tint = true;
}

}  // namespace

int main(int argc, char** argv)
{
	try {
		if (argc == 2 && argv[1] == std::string("--parameters")) {
			std::cout << ParameterHelp();
			return std::cout.flush() ? 0 : 1;
		}
		LabelRequest request;
		std::set<std::string> given;
		for (int i = 1; i < argc; ++i) given.insert(Apply(argv[i], request));
		Imply(given, request);
		std::cout << ScriptText(request);
		return std::cout.flush() ? 0 : 1;
	} catch (const RequestError& error) {
		std::cerr << ErrorText(error) << '\n';
		return 2;
	} catch (const std::invalid_argument& error) {
		std::cerr << error.what() << '\n';
		return 2;
	}
}
