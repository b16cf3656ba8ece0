# textlabel_options: what all of our own code is compiled with.

add_library(textlabel_options INTERFACE)
if(MSVC)
	target_compile_options(textlabel_options INTERFACE /W4 /utf-8 $<$<BOOL:${TEXTLABEL_WERROR}>:/WX>)
	target_compile_definitions(textlabel_options INTERFACE _USE_MATH_DEFINES NOMINMAX)
else()
	target_compile_options(textlabel_options INTERFACE
		-Wall -Wextra -Wshadow -Wconversion $<$<BOOL:${TEXTLABEL_WERROR}>:-Werror>
		-ffp-contract=off)  # fused multiply-adds would break the error bounds of the predicates and the same bytes everywhere
	if(TEXTLABEL_SANITIZE)
		target_compile_options(textlabel_options INTERFACE
			-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
			$<$<CXX_COMPILER_ID:Clang>:-fsanitize=fuzzer-no-link>)  # the coverage that tests/fuzz.sh is guided by
		target_link_options(textlabel_options INTERFACE -fsanitize=address,undefined)
	endif()
	if(NOT APPLE)
		target_link_options(textlabel_options INTERFACE -Wl,--as-needed)
	endif()
endif()
