# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

install_library()
foreach(precision IN LISTS precisions)
	flags_of(${precision} how)
	foreach(standard IN ITEMS 11 14 17 20)
		run(${compiler} ${how} -std=c++${standard} -fno-exceptions -fno-rtti -Wall -Wextra -Werror -fsyntax-only "${sources}/game/after.cpp")
	endforeach()
endforeach()

# The library's own sources as one file, as a game compiles them with its Bullet.
file(GLOB_RECURSE parts "${root}/src/*.cpp")
list(TRANSFORM parts REPLACE "(.+)" "#include \"\\1\"\n")
list(JOIN parts "" all)
file(WRITE "${work}/library.cpp" "${all}")
# C++17 is what it is built with anyway, and C++14 by Package.overlay.
run(${compiler} ${how} -std=c++20 "-I${root}/src" -fno-exceptions -fno-rtti -Wall -Wextra -Werror -fsyntax-only "${work}/library.cpp")
