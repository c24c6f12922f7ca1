# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

# Reads each block of C++ in README and in the pages for users. A block without includes is a part of a function in which the names of
# Snippets.h are known.
set(includes "-I${root}/src")
foreach(page IN ITEMS README docs/joints docs/solver docs/games docs/performance)
	file(READ "${root}/${page}.md" text)
	# Lists are made of semicolons, and square brackets hold them together.
	string(REPLACE ";" "<semicolon>" text "${text}")
	string(REPLACE "[" "<open>" text "${text}")
	string(REPLACE "]" "<close>" text "${text}")
	string(REGEX MATCHALL "\n[ ]*```cpp\n[^`]*```" blocks "${text}")
	set(functions "#include \"${sources}/Snippets.h\"\n")
	set(number 0)
	foreach(block IN LISTS blocks)
		string(REGEX REPLACE "^\n[ ]*```cpp\n" "" block "${block}")
		string(REGEX REPLACE "[ ]*```$" "" block "${block}")
		if(block MATCHES "int main")
			continue()  # the smallest program, which is built and run
		endif()
		math(EXPR number "${number} + 1")
		string(REGEX MATCHALL "#include [^\n]*\n" lines "${block}")
		string(REGEX REPLACE "#include [^\n]*\n" "" block "${block}")
		string(REPLACE ";" "" lines "${lines}")
		set(functions "${lines}${functions}void snippet${number}(SNIPPET_NAMES)\n{\n{\n#line 1 \"${page}-${number}\"\n${block}\n}\n}\n")
	endforeach()
	string(REPLACE "<semicolon>" ";" functions "${functions}")
	string(REPLACE "<open>" "[" functions "${functions}")
	string(REPLACE "<close>" "]" functions "${functions}")
	string(REPLACE "/" "-" name "${page}")
	file(WRITE "${work}/${name}.cpp" "${functions}")
	message(STATUS "${page}: ${number} blocks")
	run(${compiler} ${flags} -std=c++14 -fsyntax-only -Wno-unused ${includes} -isystem "${bullet}" "${work}/${name}.cpp")
endforeach()
