# cmake -DFONT=<font file> -DOUTPUT=<file.cpp> -P embed_font.cmake: the font's bytes as a C++ array (see embedded_font.h).
file(READ "${FONT}" bytes HEX)
string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
file(WRITE "${OUTPUT}" "#include \"filter_textlabel/embedded_font.h\"
namespace textlabel {
const unsigned char embeddedFont[] = {${bytes}};
const std::size_t embeddedFontSize = sizeof embeddedFont;
}
")
