# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

# One set of sources, two precisions. Each function makes the target <name> on the float library and <name>-float64
# on the double one; what stands after LINK and comes in both is given by its plain name.
#
#   ep_add_library(<name> SOURCES ... [INCLUDE <directory>...] [LINK <target>...] [ANY_PRECISION])
#   ep_add_executable(<name> SOURCES ... [LINK <target>...] [ONE_PRECISION])
#   ep_add_test(<name> SOURCES ... [LINK <target>...] [DRAWS] [ONE_PRECISION] [PROPERTIES <ctest's>...])
#                                                         GoogleTest; targets <name>-float and <name>-double, which ep-tests builds, too,
#                                                         tests <suite>.float, ...
#   ep_add_window_test(<name> COMMAND ...)                what opens a window, run on a virtual display
#
# ONE_PRECISION makes one target alone: in float, as a game would, where there is a choice. A program's is <name>.
# ANY_PRECISION is for a library without Bullet: one target for both, <name>.
# With EP_LIBRARIES_ON_DEMAND libraries are built where a program needs them.
# DRAWS is for what draws pictures by OpenGL.
# Without sources a library has headers only, and an executable is left out.

ep_find_bullet(EP_PRECISIONS "${BULLET_EP_PRECISION}")
if(NOT EP_PRECISIONS)
	message(FATAL_ERROR "${_ep_bullet_missing}")
endif()
string(REPLACE ";" " and " offer "${EP_PRECISIONS}")
string(REPLACE "float and double" both default "${offer}")
set(BULLET_EP_PRECISION ${default} CACHE STRING "Precision of Bullet to build for: float, double or both")
set_property(CACHE BULLET_EP_PRECISION PROPERTY STRINGS both float double)
if(BULLET_EP_PRECISION IN_LIST EP_PRECISIONS)
	set(EP_PRECISIONS ${BULLET_EP_PRECISION})
elseif(NOT BULLET_EP_PRECISION STREQUAL default)
	message(FATAL_ERROR "BULLET_EP_PRECISION is ${BULLET_EP_PRECISION}, but the Bullet found offers ${offer}.")
endif()
message(STATUS "Bullet comes in ${offer}; building for ${BULLET_EP_PRECISION}")

set(EP_SUFFIX_float "")
set(EP_SUFFIX_double -float64)
foreach(precision IN LISTS EP_PRECISIONS)
	ep_import_bullet(${precision})
endforeach()

function(_ep_link target scope precision)
	foreach(library IN LISTS ARGN)
		if(TARGET ${library}${EP_SUFFIX_${precision}})
			string(APPEND library ${EP_SUFFIX_${precision}})
		endif()
		target_link_libraries(${target} ${scope} ${library})
	endforeach()
endfunction()

function(_ep_compile target)
	set_target_properties(${target} PROPERTIES CXX_STANDARD 17 CXX_EXTENSIONS OFF)
	target_compile_features(${target} PUBLIC cxx_std_17)
	if(BULLET_EP_DEVELOPER)
		target_compile_options(${target} PRIVATE $<IF:$<CXX_COMPILER_ID:MSVC>,/W4;/WX,-Wall;-Wextra;-Werror>)
	endif()
endfunction()

function(_ep_executable target precision)
	cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "SOURCES;LINK")
	add_executable(${target} ${arg_SOURCES})
	_ep_compile(${target})
	set_target_properties(${target} PROPERTIES UNITY_BUILD OFF POSITION_INDEPENDENT_CODE OFF)
	_ep_link(${target} PRIVATE ${precision} ${arg_LINK})
endfunction()

function(ep_add_library name)
	cmake_parse_arguments(PARSE_ARGV 1 arg "ANY_PRECISION" "" "SOURCES;INCLUDE;LINK")
	set(precisions ${EP_PRECISIONS})
	if(arg_ANY_PRECISION)
		set(precisions any)
	endif()
	foreach(precision IN LISTS precisions)
		set(target ${name}${EP_SUFFIX_${precision}})
		if(arg_SOURCES)
			set(scope PUBLIC)
			add_library(${target} ${arg_SOURCES})
			set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL "${EP_LIBRARIES_ON_DEMAND}")
			_ep_compile(${target})
		else()
			set(scope INTERFACE)
			add_library(${target} INTERFACE)
		endif()
		target_include_directories(${target} ${scope} ${arg_INCLUDE})
		_ep_link(${target} ${scope} ${precision} ${arg_LINK})
	endforeach()
endfunction()

function(ep_add_executable name)
	cmake_parse_arguments(PARSE_ARGV 1 arg "ONE_PRECISION" "" "SOURCES;LINK")
	if(NOT arg_SOURCES)
		message(STATUS "${name}: no sources, left out")
	elseif(arg_ONE_PRECISION)
		list(GET EP_PRECISIONS 0 precision)
		_ep_executable(${name} ${precision} SOURCES ${arg_SOURCES} LINK ${arg_LINK})
	else()
		foreach(precision IN LISTS EP_PRECISIONS)
			_ep_executable(${name}${EP_SUFFIX_${precision}} ${precision} SOURCES ${arg_SOURCES} LINK ${arg_LINK})
		endforeach()
	endif()
endfunction()

set(EP_OF_DRAWING_TESTS ENVIRONMENT ASAN_OPTIONS=detect_leaks=0)  # graphics drivers leak

# Adds a test for each suite of a GoogleTest program: most single tests take less time than a process to start. The program is asked for
# its suites when they are to run: one that cannot start fails the tests, not the build.
function(ep_add_suites program suffix)
	get_property(is_multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
	set(file ${CMAKE_CURRENT_BINARY_DIR}/${program}-suites)
	set(PROPERTIES ${ARGN})
	configure_file(${PROJECT_SOURCE_DIR}/cmake/Suites.cmake.in ${file}.cmake.in @ONLY)
	if(is_multi_config)
		file(GENERATE OUTPUT ${file}-$<CONFIG>.cmake INPUT ${file}.cmake.in)
		file(WRITE ${file}.cmake "include(\"${file}-\${CTEST_CONFIGURATION_TYPE}.cmake\")\n")
	else()
		file(GENERATE OUTPUT ${file}.cmake INPUT ${file}.cmake.in)
	endif()
	set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${file}.cmake)
endfunction()

function(ep_add_test name)
	cmake_parse_arguments(PARSE_ARGV 1 arg "DRAWS;ONE_PRECISION" "" "SOURCES;LINK;PROPERTIES")
	set(properties ${arg_PROPERTIES})
	if(arg_DRAWS)
		list(APPEND properties ${EP_OF_DRAWING_TESTS})
	endif()
	if(NOT arg_SOURCES)
		message(STATUS "${name}: no sources, left out")
		return()
	endif()
	set(precisions ${EP_PRECISIONS})
	if(arg_ONE_PRECISION)
		list(GET EP_PRECISIONS 0 precisions)
	endif()
	foreach(precision IN LISTS precisions)
		set(target ${name}-${precision})
		_ep_executable(${target} ${precision} SOURCES ${arg_SOURCES} LINK ${arg_LINK} GTest::gtest_main)
		# A file of tests has a namespace of its own, by its name. Half of the time goes into what each would instantiate for itself.
		set_target_properties(${target} PROPERTIES UNITY_BUILD "${CMAKE_UNITY_BUILD}")
		target_precompile_headers(${target} REUSE_FROM ElasticPlasticTestHeaders${EP_SUFFIX_${precision}})
		ep_add_suites(${target} .${precision} ${properties})
		add_dependencies(ep-tests ${target})
	endforeach()
endfunction()

function(ep_add_window_test name)
	cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "COMMAND")
	find_program(XVFB_RUN xvfb-run)
	if(XVFB_RUN)
		add_test(NAME ${name} COMMAND ${XVFB_RUN} -a -s "-screen 0 1280x720x24" ${arg_COMMAND})
		set_tests_properties(${name} PROPERTIES ${EP_OF_DRAWING_TESTS})
	else()
		message(STATUS "${name}: xvfb-run not found, left out")
	endif()
endfunction()
