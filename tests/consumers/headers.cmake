# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

install_library()
set(root "${prefix}/include/bullet-elastic-plastic")
file(GLOB_RECURSE headers RELATIVE "${root}" "${root}/*.h")
list(LENGTH headers count)
if(count LESS 20)
	message(FATAL_ERROR "Only ${count} headers are installed")
endif()
set(all "")
foreach(header IN LISTS headers)
	string(APPEND all "#include \"${header}\"\n")
	file(WRITE "${work}/one.cpp" "#include \"${header}\"\n#include \"${header}\"\n")
	list(GET precisions 0 precision)
	flags_of(${precision} how)
	run(${compiler} ${how} -std=c++11 -fsyntax-only -Wall -Wextra -Werror "${work}/one.cpp")
endforeach()
file(WRITE "${work}/all.cpp" "${all}")
foreach(precision IN LISTS precisions)
	flags_of(${precision} how)
	run(${compiler} ${how} -std=c++11 -fsyntax-only -fno-exceptions -fno-rtti -Wall -Wextra -Wconversion -Wsign-conversion
		-Wshadow -Wold-style-cast -Werror "${work}/all.cpp")
endforeach()
