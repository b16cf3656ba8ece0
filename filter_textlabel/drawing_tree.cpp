#include "drawing_tree.h"

#include <exception>
#include <expat.h>
#include <memory>
#include <new>
#include "text_error.h"

namespace textlabel {
namespace {

constexpr char kSvg[] = "http://www.w3.org/2000/svg";
constexpr char kXlink[] = "http://www.w3.org/1999/xlink";
constexpr char kSeparator = '|';
/// What is nested deeper, or has more elements, is no drawing: both would be a long way through it.
constexpr std::size_t kMostDepth = 200, kMostElements = 200000;

TextError Unreadable(const std::string& why) { return TextError(TextErrorCode::DrawingUnreadable, why); }

/// Builds the tree from what Expat tells.
class TreeBuilder {
public:
	TreeBuilder() : m_parser(XML_ParserCreateNS(nullptr, kSeparator), XML_ParserFree)
	{
		if (!m_parser) throw std::bad_alloc();
		XML_SetUserData(m_parser.get(), this);
		XML_SetElementHandler(
			m_parser.get(),
			[](void* self, const char* name, const char** attributes) {
				static_cast<TreeBuilder*>(self)->guarded([&](TreeBuilder& b) { b.begin(name, attributes); });
			},
			[](void* self, const char*) { static_cast<TreeBuilder*>(self)->guarded([](TreeBuilder& b) { b.end(); }); });
		XML_SetCharacterDataHandler(m_parser.get(), [](void* self, const char* text, int length) {
			static_cast<TreeBuilder*>(self)->guarded([&](TreeBuilder& b) {
				if (!b.m_open.empty()) b.m_open.back().text.append(text, static_cast<std::size_t>(length));
			});
		});
	}

	SvgNode run(const std::string& bytes)
	{
		const auto status = XML_Parse(m_parser.get(), bytes.data(), static_cast<int>(bytes.size()), XML_TRUE);
		if (m_failure) std::rethrow_exception(m_failure);
		if (status != XML_STATUS_OK)
			throw Unreadable("it is no XML: " + std::string(XML_ErrorString(XML_GetErrorCode(m_parser.get()))) +
			                 " on line " + std::to_string(XML_GetCurrentLineNumber(m_parser.get())));
		return std::move(m_root);
	}

private:
	/// Nothing may be thrown through Expat, which is C.
	template <class Work>
	void guarded(const Work& work)
	{
		if (m_failure) return;
		try {
			work(*this);
		} catch (...) {
			m_failure = std::current_exception();
			XML_StopParser(m_parser.get(), XML_FALSE);
		}
	}

	void begin(const char* name, const char** attributes)
	{
		if (m_open.size() == kMostDepth) throw Unreadable("its elements are nested too deeply");
		if (++m_count > kMostElements) throw Unreadable("it has too many elements");
		SvgNode node;
		const std::string full = name;
		const std::size_t separator = full.rfind(kSeparator);
		if (separator == std::string::npos) node.name = full;
		else if (full.compare(0, separator, kSvg) == 0) node.name = full.substr(separator + 1);
		node.line = static_cast<int>(XML_GetCurrentLineNumber(m_parser.get()));
		for (; *attributes; attributes += 2) {
			const std::string attribute = attributes[0];
			const std::size_t end = attribute.rfind(kSeparator);
			if (end == std::string::npos) node.attributes[attribute] = attributes[1];
			else if (attribute.compare(0, end, kXlink) == 0)
				node.attributes.emplace(attribute.substr(end + 1), attributes[1]);
		}
		m_open.push_back(std::move(node));
	}
	void end()
	{
		SvgNode done = std::move(m_open.back());
		m_open.pop_back();
		if (m_open.empty()) m_root = std::move(done);
		else m_open.back().children.push_back(std::move(done));
	}

	std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> m_parser;
	std::vector<SvgNode> m_open;  ///< from the root to where the parser is
	SvgNode m_root;
	std::size_t m_count = 0;
	std::exception_ptr m_failure;
};

}  // namespace

const std::string& SvgNode::operator[](const char* attribute) const
{
	static const std::string none;
	const auto found = attributes.find(attribute);
	return found == attributes.end() ? none : found->second;
}

SvgNode ParseSvg(const std::string& bytes)
{
	SvgNode root = TreeBuilder().run(bytes);
	if (root.name != "svg") throw Unreadable("it is XML, but no SVG");
	return root;
}

}  // namespace textlabel
