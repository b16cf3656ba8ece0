#pragma once
// Numbers and words as SVG writes them: 1.5-.5e1,3 are three numbers.

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace textlabel {

/// Reads a text from its beginning.
class Scanner {
public:
	explicit Scanner(std::string_view text) : m_text(text) {}

	/// Go over blanks, and over one comma among them.
	void skipBlanks()
	{
		bool hadComma = false;
		while (!m_text.empty() && (IsBlank(m_text[0]) || (m_text[0] == ',' && !hadComma))) {
			hadComma = hadComma || m_text[0] == ',';
			m_text.remove_prefix(1);
		}
	}
	bool atEnd()
	{
		skipBlanks();
		return m_text.empty();
	}
	/// The next character, or 0 at the end.
	char peek()
	{
		skipBlanks();
		return m_text.empty() ? '\0' : m_text[0];
	}
	char take()
	{
		const char c = peek();
		if (!m_text.empty()) m_text.remove_prefix(1);
		return c;
	}
	/// The next number; none, and nothing taken, where there is no finite one.
	std::optional<double> number()
	{
		skipBlanks();
		std::string_view rest = m_text;
		const bool hasPlus = !rest.empty() && rest[0] == '+';
		if (hasPlus) rest.remove_prefix(1);
		const std::string_view digits = !hasPlus && !rest.empty() && rest[0] == '-' ? rest.substr(1) : rest;
		if (digits.empty() || !(IsDigit(digits[0]) || digits[0] == '.')) return std::nullopt;  // no inf, no nan
		double value = 0;
		const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
		if (error != std::errc()) return std::nullopt;
		m_text.remove_prefix(static_cast<std::size_t>(end - m_text.data()));
		return value;
	}
	/// The letters that come next, as a unit or a function's name.
	std::string word()
	{
		std::string word;
		for (; !m_text.empty() && (IsLetter(m_text[0]) || m_text[0] == '%'); m_text.remove_prefix(1)) word += m_text[0];
		return word;
	}

	static bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }
	static bool IsDigit(char c) { return c >= '0' && c <= '9'; }
	static bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

private:
	std::string_view m_text;
};

}  // namespace textlabel
