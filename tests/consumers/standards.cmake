# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

install_library()
foreach(precision IN LISTS precisions)
	flags_of(${precision} how)
	foreach(standard IN ITEMS 11 14 17 20)
		run(${compiler} ${how} -std=c++${standard} -fno-exceptions -fno-rtti -Wall -Wextra -Werror -fsyntax-only "${sources}/game/after.cpp")
	endforeach()
endforeach()
