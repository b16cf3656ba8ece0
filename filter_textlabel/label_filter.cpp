#include "label_filter.h"
#include "filter_script.h"
#include "label_service.h"
#include "picture.h"
#include "request_parameters.h"
#include "view_grabber.h"

#include <QFileInfo>
#include <QSaveFile>
#include <iostream>

namespace textlabel {
namespace {

vcg::Matrix44d MatrixOf(const CMeshO& m)
{
	vcg::Matrix44d matrix;
	for (int row = 0; row < 4; ++row)
		for (int column = 0; column < 4; ++column) matrix.ElementAt(row, column) = double(m.Tr.ElementAt(row, column));
	return matrix;
}

/// What the layer holds beside its mesh, kept right however the label ends. Face colours are added for it, and taken away again when
/// it is refused; when it is made, what the layer's adjacency says is no longer so, and MeshLab makes it anew when it is asked for.
class LayerData {
public:
	/// @param[in] context  asked at the end whether the label is made
	LayerData(MeshModel& model, bool wantsColors, const ErrorContext& context)
		: model_(model), context_(context), added_(wantsColors && !model.hasDataMask(MeshModel::MM_FACECOLOR))
	{
		if (!added_) return;
		model_.updateDataMask(MeshModel::MM_FACECOLOR);
		if (model_.hasDataMask(MeshModel::MM_VERTCOLOR))  // the part keeps its colours beside the letters
			vcg::tri::UpdateColor<CMeshO>::PerFaceFromVertex(model_.cm);
	}
	~LayerData()
	{
		if (context_.isMade) model_.clearDataMask(MeshModel::MM_FACEFACETOPO | MeshModel::MM_VERTFACETOPO);
		else if (added_) model_.clearDataMask(MeshModel::MM_FACECOLOR);
	}
	LayerData(const LayerData&) = delete;
	LayerData& operator=(const LayerData&) = delete;

private:
	MeshModel& model_;
	const ErrorContext& context_;
	const bool added_;
};

/// Find out before the mesh is changed. QSaveFile would put a file in the place of a pipe or a device, for root even of /dev/null.
void RequireWritable(const char* parameter, const std::string& path)
{
	if (path.empty()) return;
	const QFileInfo there(QString::fromStdString(path));
	QSaveFile file(there.filePath());
	if ((there.exists() && !there.isFile()) || !file.open(QIODevice::WriteOnly))
		throw RequestError(RequestProblem::FileNotWritten, parameter, path);
	file.cancelWriting();
}

void RequirePictureFormat(const std::string& path)
{
	if (!path.empty() && PictureFormat(path).empty())
		throw RequestError(RequestProblem::UnreadableValue, "picture", path);
}

void WriteText(const char* parameter, const std::string& path, const std::string& text)
{
	QSaveFile file(QString::fromStdString(path));
	const qint64 size = qint64(text.size());
	if (!file.open(QIODevice::WriteOnly) || file.write(text.data(), size) != size || !file.commit())
		throw RequestError(RequestProblem::FileNotWritten, parameter, path);
}

enum class PartColors { None, OfVertices, OfFaces };

PartColors ColorsOf(const MeshModel& model)
{
	if (model.hasDataMask(MeshModel::MM_FACECOLOR)) return PartColors::OfFaces;
	return model.hasDataMask(MeshModel::MM_VERTCOLOR) ? PartColors::OfVertices : PartColors::None;
}

/// @param[in] isLabel  #triangles of GeometryOf: these have the label's colour
std::vector<PictureColor> PictureColors(const CMeshO& m, PartColors which, const std::vector<std::uint8_t>& isLabel,
                                        const PictureColor& label)
{
	std::vector<PictureColor> colors;
	for (const auto& f : m.face) {
		if (f.IsD() || which == PartColors::None) continue;
		PictureColor color = label;
		for (int i = 0; i < 3 && !isLabel[colors.size()]; ++i)
			color[size_t(i)] =
				which == PartColors::OfFaces
					? f.cC()[i]
					: static_cast<unsigned char>((f.cV(0)->cC()[i] + f.cV(1)->cC()[i] + f.cV(2)->cC()[i]) / 3);
		colors.push_back(color);
	}
	return colors;
}

/// @param[in] colors  that the part had before the label
void DrawPicture(const CMeshO& m, PartColors colors, const LabelJob<CMeshO>& job, const LabelReport& report)
{
	PictureOptions options;
	if (report.request.style == LabelStyle::Flat || report.request.tint) options.label = report.request.color;
	const PartGeometry part = GeometryOf(m, job.frame().toWorld);
	const auto isLabel = MarkTriangles(m, {&job.result().topFaces, &job.result().wallFaces});
	const PictureMesh mesh{part.positions, part.triangles, PictureColors(m, colors, isLabel, options.label), isLabel};
	const vcg::Point3d direction = report.request.pictureBack ? -job.frame().w : job.frame().w;
	if (!WritePicture(RenderLabelPicture(mesh, direction, job.frame().v, options), report.request.picture))
		throw RequestError(RequestProblem::FileNotWritten, "picture", report.request.picture);
}

/// @param[out] report  as soon as the label is made
void Label(MeshDocument& document, const LabelRequest& request, vcg::CallBackPos* progress, ErrorContext& context,
           LabelReport& report)
{
	if (!document.mm()) throw RequestError(RequestProblem::EmptyPart);
	MeshModel& model = *document.mm();
	RequireWritable("report", request.report);
	RequirePictureFormat(request.picture);
	RequireWritable("picture", request.picture);
	RequireWritable("outline", request.outline);
	ServiceHost host;
	host.currentView = CurrentView;
	if (progress) host.progress = [progress](int percent) { return progress(percent, "Text Label\n"); };
	const PartColors colors = ColorsOf(model);
	const LayerData data(model, request.style == LabelStyle::Flat || request.tint, context);
	LabelJob<CMeshO> job(model.cm, MatrixOf(model.cm), host, context);
	report = job.run(request);
	if (!request.report.empty()) WriteText("report", request.report, ReportJson(report) + "\n");
	if (!request.outline.empty()) WriteText("outline", request.outline, OutlineToSvg(job.outline()));
	if (!request.picture.empty()) DrawPicture(model.cm, colors, job, report);
}

std::string Spoilt(const std::string& what)
{
	return "Refused: " + what + ". The mesh may be incomplete; load it again.";
}

/// @return a sentence for what was thrown, or nothing
/// @throws std::bad_alloc where there is no memory for the sentence
template <class Work>
std::string SentenceOf(const Work& work)
{
	ErrorContext context;
	const auto told = [&context](const std::string& text) {
		return context.isMade ? "The label was made, but not all was written: " + text : text;
	};
	try {
		work(context);
		return {};
	} catch (const vcg::textlabel::Error& error) {
		return ErrorText(error, context);
	} catch (const TextError& error) {
		return ErrorText(error);
	} catch (const RequestError& error) {
		return told(ErrorText(error));
	} catch (const std::bad_alloc&) {
		return context.isMade ? told("not enough memory.")
		                      : ErrorText(vcg::textlabel::Error(vcg::textlabel::ErrorCode::OutOfMemory));
	} catch (const std::exception& error) {
		const std::string what = std::string("something unexpected happened (") + error.what() + ")";
		return context.isMade ? told(what + ".") : Spoilt(what);
	} catch (...) {
		const std::string what = "something unexpected happened";
		return context.isMade ? told(what + ".") : Spoilt(what);
	}
}

/// The one place where exceptions end: one that left a filter would end MeshLab.
template <class Work>
std::string Guarded(const Work& work) noexcept
{
	try {
		return SentenceOf(work);
	} catch (...) {
		return "Out of memory.";  // so short that a string holds it without asking for some
	}
}

/// A text as a window shows it, log and message boxes alike: as HTML, where a script's tags, or a '<' of the label, would vanish.
std::string Shown(const std::string& text)
{
	if (!HasWindow()) return text;
	const QString escaped = QString::fromStdString(text).toHtmlEscaped();
	return "<span style=\"white-space: pre-wrap\">" + escaped.toStdString() + "</span>";
}

/// One line, so that who reads a log finds the whole message.
void Say(std::string message, const std::function<void(const std::string&)>& log)
{
	std::replace(message.begin(), message.end(), '\n', ' ');
#if MESHLAB_API == 2020  // meshlabserver shows no log of a filter that refuses; later hosts pass the exception on
	std::cerr << "Text Label: " << message << std::endl;
#endif
	log(Shown("Text Label: " + message));
}

}  // namespace

QString FilterTitle() { return filterName; }

QString FilterDescription()
{
	return "Cuts a text into the surface: raised, sunk, or flat in another colour. Turn the part until the place of "
		   "the label is in "
		   "the centre of the window, and press Apply.<br>See: <i>Slabaugh, Mihalef, Unal</i>, <b>\"A Contour-Based "
		   "Approach to 3D "
		   "Text Labeling on Triangulated Surfaces\"</b>, 3DIM 2005.";
}

/// Not face colours: MeshLab would give them to each part that is labelled, and so to its STL file; those that a label needs are added
/// by LayerData.
int FilterPostCondition()
{
	return MeshModel::MM_VERTCOORD | MeshModel::MM_VERTNUMBER | MeshModel::MM_FACENUMBER | MeshModel::MM_FACEVERT |
	       MeshModel::MM_FACENORMAL | MeshModel::MM_VERTNORMAL | MeshModel::MM_FACEFLAGSELECT;
}

void AddFilterParameters(const MeshModel& model, RichParameterList& list)
{
	LabelRequest defaults;
	Guarded(
		[&](ErrorContext&) {  // this is MeshLab's own process, and a dialog without defaults that fit is better than none
			if (HasWindow()) defaults = WindowDefaults(BoxesOf(model.cm, MatrixOf(model.cm)).world);
		});
	AddParameters(defaults, list);
}

FilterOutcome ApplyFilter(MeshDocument& document, const RichParameterList& list, vcg::CallBackPos* progress,
                          const FilterHost& host) noexcept
{
	FilterOutcome outcome;
	bool isFromWindow = false, hasWindow = false;
	outcome.message = Guarded([&](ErrorContext& context) {
		hasWindow = HasWindow();
		const LabelRequest request = ReadParameters(list);
		isFromWindow = request.placement == PlacementKind::CurrentView;
		Label(document, request, progress, context, outcome.report);
	});
	const bool isReported = !outcome.report.milliseconds.empty();
	outcome.ok = outcome.message.empty() || (isReported && hasWindow);
	Guarded([&](ErrorContext&) {
		if (!outcome.message.empty()) Say(outcome.message, host.log);
		if (!outcome.ok) return;
		Say(ReportJson(outcome.report), host.log);
#if MESHLAB_API == 2020
		host.log(Shown(ScriptText(outcome.report.request)));
#else
		host.log(Shown(PythonCall(outcome.report.request)));
#endif
		if (!outcome.report.survivesFloat32)
			Say("the letters are finer than single precision carries so far from the origin. Save the part as PLY, OBJ "
			    "or OFF with "
			    "double precision; an STL file would spoil them.",
			    host.log);
		const LabelRequest& used = outcome.report.request;
		if (hasWindow && (used.style == LabelStyle::Flat || used.tint))
			Say("the letters have their colour. To see it here, choose Color: Face in the pane beside this window.",
			    host.log);
		if (isFromWindow && host.noteUsedView) host.noteUsedView(outcome.report.request);
	});
	if (!outcome.ok) Guarded([&](ErrorContext&) { outcome.message = Shown(outcome.message); });
	return outcome;
}

}  // namespace textlabel
