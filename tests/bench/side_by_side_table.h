#pragma once
// The figures of the side-by-side: what was timed, whether the results are valid, and the table.

#include "peer.h"
#include "vcg_ext/validate.h"

#include <fstream>
#include <iomanip>
#include <sstream>

namespace bench {

/// Runs of one thing.
struct Series {
	std::vector<double> seconds;
	std::string valid;

	double sum() const
	{
		double s = 0;
		for (const double x : seconds) s += x;
		return s;
	}
	double median() const
	{
		std::vector<double> sorted = seconds;
		std::sort(sorted.begin(), sorted.end());
		const size_t n = sorted.size();
		return n == 0 ? -1 : (sorted[(n - 1) / 2] + sorted[n / 2]) / 2;
	}
	bool isThere() const { return !seconds.empty() && seconds.back() >= 0; }
};

struct PeerTimes {
	std::string name;
	Series whole, wholeAlone, cropped, croppedAlone;  ///< from arrays to arrays, and the boolean alone
};

struct Row {
	int triangles = 0, underBox = 0;
	std::string text, valid;
	Series ours, oursFirst, pass, copy;
	std::vector<PeerTimes> peers;
};

/// Judges results against what they were made from.
class Judge {
public:
	explicit Judge(const IndexedMesh& before) : before_(ReportOf(before)) {}

	/// "yes", or what is wrong.
	std::string verdict(const IndexedMesh& result) const
	{
		constexpr size_t searched = 110000;  // triangles; above it crossings take longer than all the rest
		const IndexedMesh rounded = vcg::textlabel::PrepareForReport(result, {true, true});
		const vcg::textlabel::MeshReport r = vcg::textlabel::MakeReport(rounded);
		std::ostringstream wrong;
		const auto count = [&wrong](int n, const char* what) {
			if (n > 0) wrong << (wrong.tellp() > 0 ? ", " : "") << n << ' ' << what;
		};
		count(r.borderEdges, "open edges");
		count(r.nonManifoldEdges + r.nonManifoldVertices, "non-manifold");
		count(r.flippedEdges, "flipped");
		count(r.collinearFaces + r.repeatedIndexFaces, "without area");
		count(r.duplicateFaces, "double");
		if (r.components != before_.components) count(r.components, "components");
		if (r.genus != before_.genus) count(std::max(1, r.genus.value_or(1)), "genus");
		if (rounded.faces.size() <= searched) count(CountCrossings(rounded), "crossing pairs");
		return wrong.tellp() > 0 ? wrong.str() : "yes";
	}

private:
	static vcg::textlabel::MeshReport ReportOf(const IndexedMesh& mesh)
	{
		return vcg::textlabel::MakeReport(vcg::textlabel::PrepareForReport(mesh, {true, true}));
	}
	const vcg::textlabel::MeshReport before_;
};

/// The fastest of some series; null when there is none.
inline const Series* Fastest(const Row& row, Series PeerTimes::*which)
{
	const Series* best = nullptr;
	for (const PeerTimes& p : row.peers)
		if ((p.*which).isThere() && (!best || (p.*which).median() < best->median())) best = &(p.*which);
	return best;
}

/// A number with three figures.
inline std::string Figures(double x)
{
	std::ostringstream out;
	out << std::fixed << std::setprecision(x < 1 ? 3 : x < 10 ? 2 : x < 100 ? 1 : 0) << x;
	return out.str();
}

inline std::string Milliseconds(const Series* s) { return s && s->isThere() ? Figures(s->median() * 1000) : "–"; }

inline std::string Ratio(const Series* slow, const Series& fast)
{
	if (!slow || !slow->isThere()) return "–";
	const double ratio = slow->median() / fast.median();
	std::ostringstream out;
	out << std::fixed << std::setprecision(ratio < 10 ? 1 : 0) << ratio << "×";
	return out.str();
}

/// All figures of a row, for the log.
inline std::string ToText(const Row& row)
{
	std::ostringstream out;
	const auto add = [&out](const std::string& name, const Series& s) {
		if (s.seconds.empty()) return;
		const auto [least, most] = std::minmax_element(s.seconds.begin(), s.seconds.end());
		out << "  " << std::left << std::setw(60) << name << std::right << std::setw(10) << Milliseconds(&s) << " ms  ("
			<< *least * 1000 << " .. " << *most * 1000 << ", " << s.seconds.size() << " runs) " << s.valid << '\n';
	};
	out << row.text << " on " << row.triangles << " triangles, " << row.underBox
		<< " under its box; valid: " << row.valid << '\n';
	add("ours", row.ours);
	add("ours, first label of a part", row.oursFirst);
	add("bare linear pass", row.pass);
	add("memcpy of the mesh", row.copy);
	for (const PeerTimes& p : row.peers) {
		add(p.name, p.whole);
		add(p.name + ", the boolean alone", p.wholeAlone);
		add(p.name + ", cropped by hand", p.cropped);
		add(p.name + ", cropped by hand, the boolean alone", p.croppedAlone);
	}
	return out.str();
}

/// The table; peers' times are from arrays to arrays, in brackets for the boolean alone.
inline std::string ToMarkdown(const std::vector<Row>& rows)
{
	std::ostringstream out, rule;
	const auto shortName = [](const PeerTimes& p) { return p.name.substr(0, p.name.find(' ')); };
	const auto both = [](const Series* whole, const Series* alone) {
		return Milliseconds(whole) + " (" + Milliseconds(alone) + ")";
	};
	const auto bothRatios = [](const Row& row, Series PeerTimes::*whole, Series PeerTimes::*alone) {
		return "**" + Ratio(Fastest(row, whole), row.ours) + "** (" + Ratio(Fastest(row, alone), row.ours) + ")";
	};
	out << "| label | triangles | ours | first label |";
	rule << "|---|--:|--:|--:|";
	for (const PeerTimes& p : rows[0].peers) {
		out << ' ' << shortName(p) << " |";
		rule << "--:|";
	}
	out << " faster | cropped by hand | faster | one pass | memcpy | valid: ours";
	for (const PeerTimes& p : rows[0].peers) out << "; " << shortName(p);
	out << " |\n" << rule.str() << "--:|--:|--:|--:|--:|---|\n";
	for (const Row& row : rows) {
		out << "| " << row.text << " | " << row.triangles << " | **" << Milliseconds(&row.ours) << "** | "
			<< Milliseconds(&row.oursFirst) << " | ";
		for (const PeerTimes& p : row.peers) out << both(&p.whole, &p.wholeAlone) << " | ";
		out << bothRatios(row, &PeerTimes::whole, &PeerTimes::wholeAlone) << " | "
			<< both(Fastest(row, &PeerTimes::cropped), Fastest(row, &PeerTimes::croppedAlone)) << " | "
			<< bothRatios(row, &PeerTimes::cropped, &PeerTimes::croppedAlone) << " | " << Milliseconds(&row.pass)
			<< " | " << Milliseconds(&row.copy) << " | " << row.valid;
		for (const PeerTimes& p : row.peers) out << "; " << p.wholeAlone.valid;
		out << " |\n";
	}
	out << '\n';
	for (const PeerTimes& p : rows[0].peers) out << p.name << ". ";
	out << '\n';
	return out.str();
}

}  // namespace bench
