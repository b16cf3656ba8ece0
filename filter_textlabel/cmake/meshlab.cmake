# Where MeshLab's headers and libraries are, and for which generation of its plugin interface they are.
#
# Sets  MESHLAB_API, MESHLAB_VERSION, MESHLAB_LIBRARY (may stay empty: the plugin then finds its symbols in its host).
# Makes meshlab_vcg  VCGlib and Eigen, header-only
#       meshlab_sdk  the plugin interface: Qt 5, GLEW, GLU, libmeshlab-common, the defines that MeshLab itself is built with

set(_vcg_places "${MESHLAB_SOURCE}/src/vcglib" "${MESHLAB_SOURCE}/vcglib")  # since 2021, before
find_path(MESHLAB_VCG_DIR vcg/complex/complex.h PATHS ${_vcg_places} NO_DEFAULT_PATH)
if(NOT MESHLAB_SOURCE OR NOT MESHLAB_VCG_DIR)
	unset(MESHLAB_VCG_DIR CACHE)
	message(FATAL_ERROR
		"MESHLAB_SOURCE is '${MESHLAB_SOURCE}': no MeshLab sources with VCGlib there (looked in ${_vcg_places}).\n"
		"Give the sources of the MeshLab that will load the plugin, for example\n"
		"  git clone --recurse-submodules -b MeshLab-2025.07 https://github.com/cnr-isti-vclab/meshlab\n"
		"  cmake -S . -B build/mine -DMESHLAB_SOURCE=meshlab\n"
		"On Debian, filter_textlabel/build.sh fetches them and builds in one step.")
endif()

if(NOT MESHLAB_VERSION)
	file(STRINGS "${MESHLAB_SOURCE}/ML_VERSION" MESHLAB_VERSION LIMIT_COUNT 1)
endif()
if(NOT MESHLAB_API)
	# 2021.05 brought the interface that 2022.02 has; 2023.12 renamed parameter classes.
	if(MESHLAB_VERSION VERSION_LESS 2021)
		set(MESHLAB_API 2020)
	elseif(MESHLAB_VERSION VERSION_LESS 2023.12)
		set(MESHLAB_API 2022)
	else()
		set(MESHLAB_API 2025)
	endif()
endif()
if(NOT MESHLAB_API MATCHES "^(2020|2022|2025)$")
	message(FATAL_ERROR "MESHLAB_API is '${MESHLAB_API}'; it must be 2020, 2022 or 2025.")
endif()
if(NOT MESHLAB_SCALAR MATCHES "^(float|double)$")
	message(FATAL_ERROR "MESHLAB_SCALAR is '${MESHLAB_SCALAR}'; it must be float or double.")
endif()
message(STATUS "MeshLab ${MESHLAB_VERSION}, plugin interface of ${MESHLAB_API}, ${MESHLAB_SCALAR} coordinates")

find_package(Eigen3 REQUIRED NO_MODULE)
add_library(meshlab_vcg INTERFACE)
target_include_directories(meshlab_vcg SYSTEM INTERFACE "${MESHLAB_VCG_DIR}")
target_link_libraries(meshlab_vcg INTERFACE Eigen3::Eigen)

# Windows cannot leave symbols to the host, so there the library is needed; elsewhere it is better to have it.
if(NOT MESHLAB_LIBRARY)
	include(GNUInstallDirs)
	find_library(_meshlab_installed meshlab-common
		PATHS "/usr/${CMAKE_INSTALL_LIBDIR}/meshlab" "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/meshlab")
	mark_as_advanced(_meshlab_installed)
	# Debian 12's MeshLab; the library carries no version, so it is not offered to another generation.
	if(_meshlab_installed AND MESHLAB_API EQUAL 2020)
		set(MESHLAB_LIBRARY "${_meshlab_installed}")
	else()
		message(STATUS "MESHLAB_LIBRARY not given: the plugin takes libmeshlab-common's symbols from the host that loads it")
	endif()
endif()

find_package(Qt5 REQUIRED COMPONENTS Core Gui Widgets OpenGL Xml)
find_package(GLEW REQUIRED)
find_package(OpenGL REQUIRED)
find_package(Threads REQUIRED)
if(NOT TARGET OpenGL::GLU)
	message(FATAL_ERROR "GLU (the OpenGL utility library, Debian: libglu1-mesa-dev) is missing.")
endif()
add_library(meshlab_sdk INTERFACE)
target_include_directories(meshlab_sdk SYSTEM INTERFACE "${MESHLAB_SOURCE}/src")
target_compile_definitions(meshlab_sdk INTERFACE
	MESHLAB_API=${MESHLAB_API} MESHLAB_SCALAR=${MESHLAB_SCALAR} MESHLAB_VERSION=${MESHLAB_VERSION})
target_link_libraries(meshlab_sdk INTERFACE
	meshlab_vcg Qt5::Core Qt5::Gui Qt5::Widgets Qt5::OpenGL Qt5::Xml GLEW::GLEW OpenGL::GLU ${MESHLAB_LIBRARY})
