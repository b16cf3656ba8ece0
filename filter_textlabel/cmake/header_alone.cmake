# textlabel_header_alone(<target> <library> <header>...): prove that each header compiles alone, and twice.
#
# Makes an object library of one translation unit for each header, compiled as <library>'s users compile it.
function(textlabel_header_alone target library)
	if(TEXTLABEL_SANITIZE)
		return()  # compiled in the other trees
	endif()
	set(units "")
	foreach(header IN LISTS ARGN)
		file(RELATIVE_PATH name "${PROJECT_SOURCE_DIR}" "${header}")
		string(MAKE_C_IDENTIFIER "${name}" unit)
		set(unit "${CMAKE_CURRENT_BINARY_DIR}/header_alone/${unit}.cpp")
		file(CONFIGURE OUTPUT "${unit}" CONTENT "#include \"@name@\"\n#include \"@name@\"\n" @ONLY)
		list(APPEND units "${unit}")
	endforeach()
	if(units)
		add_library(${target} OBJECT ${units})
		target_link_libraries(${target} PRIVATE ${library} textlabel_options)
		set_target_properties(${target} PROPERTIES AUTOMOC OFF)
		if(NOT MSVC)
			target_compile_options(${target} PRIVATE -O0)  # nobody runs it
		endif()
	endif()
endfunction()
