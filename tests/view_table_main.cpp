// view_table: labels on real parts from all sides, each judged by our report, by admesh and by CGAL; a table of what came of them.
//
// usage: view_table [--log FILE] [--keep FOLDER] [--quick] [MESH...]
//
// Each mesh (default: all of the folder of real meshes) is looked at along its axes and from each octant, and gets two texts in
// three styles: 84 labels. The table goes to the standard output; --log takes one line for each label, --keep the meshes that
// are not as they should be. --quick leaves out admesh and CGAL. Exit 1 when there is one. tests/view_table.sh builds and runs it.

#include <algorithm>
#include <chrono>
#include <iostream>

#include "view_label.h"

namespace {

using namespace view_label;
using test_mesh::Shape;

struct Arguments {
	std::string log, keep;
	bool quick = false;
	std::vector<std::filesystem::path> files;
};

/// What came of the labels on one part, or on all.
struct Tally {
	int labels = 0, third = 0, smaller = 0, refused = 0, faults = 0;
	std::map<std::string, int> reasons, thirdReasons;

	void add(const Tally& t)
	{
		labels += t.labels;
		third += t.third;
		smaller += t.smaller;
		refused += t.refused;
		faults += t.faults;
		for (const auto& [reason, count] : t.reasons) reasons[reason] += count;
		for (const auto& [reason, count] : t.thirdReasons) thirdReasons[reason] += count;
	}
};

std::string InWords(const std::map<std::string, int>& reasons)
{
	std::vector<std::pair<int, std::string>> sorted;
	for (const auto& [reason, count] : reasons) sorted.emplace_back(-count, reason);
	std::sort(sorted.begin(), sorted.end());
	std::string words;
	for (const auto& [count, reason] : sorted)
		words += (words.empty() ? "" : ", ") + reason + " " + std::to_string(-count);
	return words;
}

class TableMaker {
public:
	TableMaker(const Arguments& a, const std::string& programs) : arguments_(a), programs_(programs)
	{
		if (!a.log.empty()) log_.open(a.log);
		std::cout << "| part | at a third | smaller | refused | why refused | bad |\n|---|--:|--:|--:|---|--:|\n";
	}
	void run(const std::filesystem::path& file)
	{
		const Part part(file);
		std::optional<OtherJudges> judges;
		if (!arguments_.quick) judges.emplace(part.shape, part.isFloat, programs_);
		Tally tally;
		const std::vector<Point3d> directions = ViewDirections();
		for (size_t d = 0; d < directions.size(); ++d)
			for (const LabelStyle style : {LabelStyle::Emboss, LabelStyle::Engrave, LabelStyle::Flat})
				for (const std::string& text : ViewTexts()) {
					textlabel::LabelRequest request = RequestFrom(part, directions[d]);
					request.style = style;
					request.text = text;
					const std::string name = part.name + "\t" + std::to_string(d) + "\t" +
					                         textlabel::ChoiceNames(style)[size_t(style)] + "\t" + text;
					tally.add(label(part, request, name, judges));
				}
		printRow(part.name + (part.isFloat ? "" : " (in doubles)"), tally);
		all_.add(tally);
	}
	/// @return faults
	int finish()
	{
		printRow("all", all_);
		std::cout << "\nWhy not at a third: " << InWords(all_.thirdReasons) << ".\n";
		return all_.faults;
	}

private:
	Tally label(const Part& part, const textlabel::LabelRequest& request, const std::string& name,
	            const std::optional<OtherJudges>& judges)
	{
		Tally t;
		t.labels = 1;
		const auto started = std::chrono::steady_clock::now();
		Labelled label = Label(part, AtAThird(part, request));
		const Labelled first = label;
		if (!label.isMade && label.fault.empty()) label = Label(part, request);
		const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - started;
		(first.isMade ? t.third : label.isMade ? t.smaller : t.refused) = 1;
		if (!first.isMade) t.thirdReasons[first.reason] = 1;
		if (!label.isMade) t.reasons[label.reason] = 1;
		if (label.isMade && label.fault.empty() && judges)
			label.fault = judges->fault(label.shape, label.survivesFloat32 && part.isFloat);
		t.faults = !label.fault.empty();
		if (t.faults > 0) keep(label, name);
		if (log_.is_open())
			log_ << name << '\t'
				 << (first.isMade   ? "third"
			         : label.isMade ? "smaller"
			                        : "refused")
				 << '\t' << label.fault << '\t' << label.capitalHeight << '\t' << label.height << '\t' << took.count()
				 << '\t' << first.sentence << '\t' << label.sentence << std::endl;
		return t;
	}
	void keep(const Labelled& label, std::string name) const
	{
		std::cerr << name << ": " << label.fault << '\n';
		if (arguments_.keep.empty() || !label.isMade) return;
		for (char& c : name)
			if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
		WritePly(label.shape, arguments_.keep + "/" + name + ".ply");
	}
	static void printRow(const std::string& name, const Tally& t)
	{
		std::cout << "| " << name << " | " << t.third << " | " << t.smaller << " | " << t.refused << " | "
				  << InWords(t.reasons) << " | " << t.faults << " |" << std::endl;
	}

	const Arguments& arguments_;
	std::string programs_;
	std::ofstream log_;
	Tally all_;
};

std::vector<std::filesystem::path> AllFiles()
{
	std::vector<std::filesystem::path> files;
	std::error_code none;
	for (const auto& entry : std::filesystem::directory_iterator(Folder(), none)) {
		const std::string type = entry.path().extension().string();
		if (type == ".stl" || type == ".ply" || type == ".obj") files.push_back(entry.path());
	}
	std::sort(files.begin(), files.end());
	return files;
}

}  // namespace

int main(int count, char** values)
{
	Arguments a;
	for (int i = 1; i < count; ++i) {
		const std::string name = values[i];
		const auto value = [&] { return i + 1 < count ? values[++i] : ""; };
		if (name == "--log") a.log = value();
		else if (name == "--keep") a.keep = value();
		else if (name == "--quick") a.quick = true;
		else a.files.push_back(name);
	}
	if (a.files.empty()) a.files = AllFiles();
	if (a.files.empty()) return std::cerr << "no meshes in " << Folder() << '\n', 77;
	TableMaker table(a, std::filesystem::path(values[0]).parent_path().string());
	for (const std::filesystem::path& file : a.files) table.run(file);
	return table.finish() > 0;
}
