# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

install_library()
find_program(make NAMES gmake make REQUIRED)
find_program(cc NAMES cc gcc clang)
foreach(precision IN LISTS precisions)
	set(package bullet-elastic-plastic)
	if(precision STREQUAL double)
		string(APPEND package -float64)
	endif()
	foreach(game IN ITEMS before after)
		run("${CMAKE_COMMAND}" -E env "PKG_CONFIG_PATH=${prefix}/${libraries}/pkgconfig" "CXX=${compiler}"
			"CXXFLAGS=${flags}" ${make} -s -f "${sources}/Makefile" "PACKAGE=${package}" "SOURCE=${sources}/game/${game}.cpp"
			"OUTPUT=${work}/${game}-${precision}")
	endforeach()
	expect("${work}/before-${precision}" "height of 9.8 m")
	# The ball bends the mast.
	expect("${work}/after-${precision}" "height of 9.[5-8] m.*bent by -0.1[0-9] rad, damage 0.0[1-9]")
	# A program in C knows nothing of C++, nor does its linker.
	if(cc)
		list(JOIN flags " " c_flags)
		run("${CMAKE_COMMAND}" -E env "PKG_CONFIG_PATH=${prefix}/${libraries}/pkgconfig" sh -c
			"${cc} -std=c99 ${c_flags} '${sources}/c/sample.c' $(pkg-config --cflags --libs ${package}) -o '${work}/sample-${precision}'")
		expect("${work}/sample-${precision}" "0.329 s: event 1 of joint 3, 401[0-9] J")
	endif()
endforeach()

# The documentation shows what was changed: the lines of diff that begin with - and +.
execute_process(COMMAND diff -U0 "${sources}/game/before.cpp" "${sources}/game/after.cpp" OUTPUT_VARIABLE diff)
string(REGEX REPLACE "(---|[+][+][+]) [^\n]*/game/[^\n]*\n" "" diff "${diff}")
string(REGEX REPLACE "@@[^\n]*\n" "" diff "${diff}")
file(READ "${root}/docs/games.md" page)
string(FIND "${page}" "```diff\n${diff}```" place)
if(place LESS 0)
	message(FATAL_ERROR "docs/games.md does not show what was changed:\n${diff}")
endif()
