// The parameter table, and what hosts make of it: MeshLab's list, its scripts, Python, the command line.

#include "filter_textlabel/filter_script.h"
#include "filter_textlabel/request_error.h"
#include "filter_textlabel/request_parameters.h"

#include <QDomDocument>
#include <cmath>
#include <gtest/gtest.h>
#include <set>

using namespace textlabel;

namespace {

/// A value that differs from the default, for each type of member.
struct ChangeValue {
	void operator()(std::string& value) const { value = "a <b> & \"c\" 'd'; e\\f=g Äß漢 𐳌"; }
	void operator()(double& value) const { value = 0.1; }
	void operator()(bool& value) const { value = !value; }
	void operator()(vcg::Point3d& value) const { value = {0.1, -25, 1e-7}; }
	void operator()(Rgb& value) const { value = {1, 2, 255}; }
	template <class Choice>
	void operator()(Choice& value) const
	{
		value = Choice((int(value) + 1) % int(ChoiceNames(value).size()));
	}
};

LabelRequest AllChanged()
{
	LabelRequest request;
	for (const Parameter& p : ParameterTable()) VisitMember(p, request, ChangeValue());
	return request;
}

/// As MeshLab reads a script.
RichParameterList Parsed(const std::string& script)
{
	QDomDocument document;
	QString message;
	EXPECT_TRUE(document.setContent(QByteArray::fromStdString(script), false, &message)) << message.toStdString();
	RichParameterList list;
	const QDomElement filter = document.documentElement().firstChildElement("filter");
	EXPECT_EQ(filter.attribute("name").toStdString(), filterName);
	for (QDomElement p = filter.firstChildElement("Param"); !p.isNull(); p = p.nextSiblingElement("Param"))
		list.pushFromQDomElement(p);
	return list;
}

void ExpectEqual(const LabelRequest& a, const LabelRequest& b)
{
	for (const Parameter& p : ParameterTable()) EXPECT_EQ(ValueText(p, a), ValueText(p, b)) << p.name;
}

template <class Work>
RequestProblem ProblemOf(const Work& work)
{
	try {
		work();
	} catch (const RequestError& error) {
		return error.problem;
	}
	ADD_FAILURE() << "no error";
	return RequestProblem::EmptyPart;
}

}  // namespace

TEST(ParameterTable, KeepsItsContract)
{
	const std::set<std::string> contract{"text",     "font",          "size",      "depth", "style",    "placement",
	                                     "camera",   "position",      "direction", "up",    "offset_u", "offset_v",
	                                     "rotation", "extrude_along", "tolerance", "align", "color"};
	std::set<std::string> names, labels;
	for (const Parameter& p : ParameterTable()) {
		EXPECT_TRUE(names.insert(p.name).second) << p.name;
		EXPECT_TRUE(labels.insert(p.label).second) << p.label;
		EXPECT_GT(std::string(p.help).size(), 10u) << p.name;
		EXPECT_FALSE(p.advanced && contract.count(p.name)) << p.name << " must be a parameter of its own in every host";
	}
	for (const std::string& name : contract) EXPECT_TRUE(names.count(name)) << name;
	EXPECT_EQ(ParameterTable().front().name, std::string("text"));
}

TEST(ParameterTable, EachValueHasATextThatReadsBack)
{
	const LabelRequest wanted = AllChanged();
	LabelRequest read;
	for (const Parameter& p : ParameterTable()) {
		EXPECT_NE(ValueText(p, wanted), ValueText(p, read)) << p.name;
		SetValue(p, read, ValueText(p, wanted));
	}
	ExpectEqual(wanted, read);
}

TEST(ParameterTable, IsListedForPeople)
{
	const std::string help = "\n" + ParameterHelp();
	for (const Parameter& p : ParameterTable()) {
		const std::string line = "\n" + std::string(p.name) + "  " + TakenText(p.name) + "; default ";
		const size_t at = help.find(line);
		ASSERT_NE(at, std::string::npos) << p.name;
		EXPECT_EQ(help.find(std::string("\n    ") + p.label + ". " + p.help + "\n", at), help.find('\n', at + 1))
			<< p.name;
	}
	EXPECT_NE(help.find("\nalign  one of Left, Center, Right; default Center\n"), std::string::npos);
	EXPECT_NE(help.find("\nreport  the name of a .json file; default empty\n"), std::string::npos);
}

TEST(ParameterTable, ReadsWhatPeopleWrite)
{
	LabelRequest r;
	SetValue(*FindParameter("style"), r, "engrave");
	EXPECT_EQ(r.style, LabelStyle::Engrave);
	SetValue(*FindParameter("placement"), r, "point");
	EXPECT_EQ(r.placement, PlacementKind::PointAndDirection);
	SetValue(*FindParameter("extrude_along"), r, "2");
	EXPECT_EQ(r.extrudeAlong, ExtrudeDirection::SurfaceNormal);
	SetValue(*FindParameter("color"), r, "#0aFF10");
	EXPECT_EQ(r.color, (Rgb{10, 255, 16}));
	SetValue(*FindParameter("position"), r, "+1,-2.5e1,.5");
	EXPECT_EQ(r.position, vcg::Point3d(1, -25, 0.5));
	for (const auto& [name, text] : {std::pair{"size", "1x"},
	                                 {"size", ""},
	                                 {"size", "1,5"},
	                                 {"position", "1,2"},
	                                 {"position", "1,2,3,4"},
	                                 {"color", "12345"},
	                                 {"color", "12345g"},
	                                 {"style", ""},
	                                 {"style", "3"},
	                                 {"style", "e"},
	                                 {"tint", "yes"}})
		EXPECT_EQ(ProblemOf([&] { SetValue(*FindParameter(name), r, text); }), RequestProblem::UnreadableValue)
			<< name << text;
}

TEST(Requests, SurviveMeshLabsParameterList)
{
	for (const LabelRequest& wanted : {LabelRequest(), AllChanged()}) {
		RichParameterList list;
		AddParameters(wanted, list);
		ExpectEqual(ReadParameters(list), wanted);  // single precision on the way: 0.1 must come back as 0.1
	}
}

TEST(Requests, SurviveAScript)
{
	for (LabelRequest wanted : {LabelRequest(), AllChanged()}) {
		wanted.text += "\nsecond\tline";
		ExpectEqual(ReadParameters(Parsed(ScriptText(wanted))), wanted);
	}
}

TEST(Requests, AScriptHasWhatMeshLabAsksFor)
{
	RichParameterList asked;
	AddParameters(LabelRequest(), asked);
	const RichParameterList given = Parsed(ScriptText(AllChanged()));
	ASSERT_EQ(given.size(), asked.size());  // one missing, and Debian's build ends with an assert
	for (unsigned i = 0; i < asked.size(); ++i) {
		EXPECT_EQ(given.at(i).name(), asked.at(i).name());
		EXPECT_EQ(given.at(i).stringType(), asked.at(i).stringType()) << asked.at(i).name().toStdString();
	}
}

TEST(Requests, RefuseWhatXmlCannotCarry)
{
	for (const std::string text : {"a\x01", "\xff", "\xc3", "\xed\xa0\x80"}) {
		LabelRequest request;
		request.text = text;
		EXPECT_EQ(ProblemOf([&] { ScriptText(request); }), RequestProblem::UnreadableValue);
	}
}

TEST(Requests, RefuseListsThatAreNotOurs)
{
	RichParameterList empty, wrong;
	EXPECT_EQ(ProblemOf([&] { ReadParameters(empty); }), RequestProblem::UnknownParameter);
	for (const Parameter& p : ParameterTable()) wrong.addParam(RichInt(p.name, 1));
	EXPECT_EQ(ProblemOf([&] { ReadParameters(wrong); }), RequestProblem::UnreadableValue);
	RichParameterList list;
	AddParameters(LabelRequest(), list);
	list.setValue("style", EnumValue(7));
	EXPECT_EQ(ProblemOf([&] { ReadParameters(list); }), RequestProblem::UnreadableValue);
}

TEST(MoreOptions, NameWhatIsNotAtItsDefault)
{
	LabelRequest request;
	EXPECT_EQ(MoreText(request), "");
	SetMore(request, "  slant = 12 ;mirrored=true;; features=tnum,ss01 ; report=/a\\;b\\\\c");
	EXPECT_EQ(request.slant, 12);
	EXPECT_TRUE(request.mirrored);
	EXPECT_EQ(request.features, "tnum,ss01");
	EXPECT_EQ(request.report, "/a;b\\c");
	LabelRequest again;
	SetMore(again, MoreText(request));
	ExpectEqual(again, request);
	for (const char* text : {"slant", "nothing=1", "=1"})
		EXPECT_EQ(ProblemOf([&] { SetMore(request, text); }), RequestProblem::UnknownParameter) << text;
	EXPECT_EQ(ProblemOf([&] { SetMore(request, "size=3"); }), RequestProblem::HasOwnField);
	EXPECT_EQ(ProblemOf([&] { SetMore(request, "slant=steep"); }), RequestProblem::UnreadableValue);
}

TEST(Requests, ArePythonToo)
{
	LabelRequest request;
	EXPECT_EQ(PythonCall(request), "ms.apply_filter('apply_text_label', text='A43')");
	request.text = "it's a\n\\";
	request.style = LabelStyle::Flat;
	request.up = {0, 1, 0};
	request.mirrored = true;
	request.color = {1, 2, 3};
	EXPECT_EQ(PythonCall(request),
	          "ms.apply_filter('apply_text_label', text='it\\'s a\\n\\\\', style='Flat', up=[0,1,0], mirrored=True, "
	          "color=pymeshlab.Color(1, 2, 3, 255))");
}

TEST(Checks, RefuseNumbersThatNoPartTakes)
{
	vcg::Box3d box(vcg::Point3d(0, 0, 0), vcg::Point3d(3, 4, 12));  // diagonal 13
	EXPECT_NO_THROW(CheckRequest(LabelRequest(), box));
	const auto problem = [&](const char* name, const char* text) {
		LabelRequest request;
		SetValue(*FindParameter(name), request, text);
		return ProblemOf([&] { CheckRequest(request, box); });
	};
	for (const char* name : {"size", "depth", "tolerance"}) {
		EXPECT_EQ(problem(name, "0"), RequestProblem::NeitherPositiveNorFit) << name;
		EXPECT_EQ(problem(name, "-0.5"), RequestProblem::NeitherPositiveNorFit) << name;
		EXPECT_EQ(problem(name, "13.001"), RequestProblem::LargerThanPart) << name;
		EXPECT_EQ(problem(name, "nan"), RequestProblem::NotANumber) << name;
		EXPECT_EQ(problem(name, "inf"), RequestProblem::NotANumber) << name;
	}
	EXPECT_EQ(problem("position", "0,nan,0"), RequestProblem::NotANumber);
	EXPECT_EQ(problem("max_stretch", "0.5"), RequestProblem::OutOfRange);
	EXPECT_EQ(problem("file_digits", "16"), RequestProblem::OutOfRange);
	EXPECT_EQ(problem("file_digits", "nan"), RequestProblem::NotANumber);
	EXPECT_EQ(problem("file_digits", "6.5"), RequestProblem::NotWhole);
	LabelRequest flat;
	flat.style = LabelStyle::Flat;
	flat.depth = 0;
	EXPECT_NO_THROW(CheckRequest(flat, box));
}

TEST(Checks, ReadNumbersAsTheyWereWritten)
{
	RichParameterList list;
	AddParameters(LabelRequest(), list);
	for (const double number : {0.1, 12.345, 1e-5, 3.6, 512345.69}) {
		list.setValue("size", FloatValue(Scalarm(number)));
		EXPECT_EQ(Scalarm(ReadParameters(list).size), Scalarm(number));
		EXPECT_NEAR(ReadParameters(list).size, number, std::abs(number) * 1e-7);
	}
	list.setValue("size", FloatValue(0.1f));
	EXPECT_EQ(ReadParameters(list).size, 0.1);
	EXPECT_NE(double(0.1f), 0.1);
}
