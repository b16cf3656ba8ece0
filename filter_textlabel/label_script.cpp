// textlabel_script NAME=VALUE...: print the filter script (.mlx) of a label, all parameters in it.
//
// label.sh runs it, so that names, types and defaults of the parameters stand in one table for scripts too.
// Exit 0, or 2 with a message on stderr when an argument is none.

#include "error_text.h"
#include "filter_script.h"

#include <iostream>

namespace {

void Apply(const std::string& argument, textlabel::LabelRequest& request)
{
	using namespace textlabel;
	const size_t equals = argument.find('=');
	const std::string name = argument.substr(0, equals);
	const Parameter* const parameter = FindParameter(name);
	if (!parameter || equals == std::string::npos) throw RequestError(RequestProblem::UnknownParameter, name);
	SetValue(*parameter, request, argument.substr(equals + 1));
}

}  // namespace

int main(int argc, char** argv)
{
	try {
		textlabel::LabelRequest request;
		for (int i = 1; i < argc; ++i) Apply(argv[i], request);
		std::cout << textlabel::ScriptText(request);
		return std::cout.flush() ? 0 : 1;
	} catch (const textlabel::RequestError& error) {
		std::cerr << textlabel::ErrorText(error) << '\n';
		return 2;
	}
}
