# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

# Package.subdirectory has built it.
list(GET precisions 0 precision)
run("${CMAKE_COMMAND}" --install "${work}/../package-subdirectory/build" --prefix "${prefix}")
file(GLOB library "${prefix}/lib/libBulletElasticPlastic*.so")
execute_process(COMMAND nm -DC --defined-only "${library}" OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
if(NOT symbols MATCHES "btElasticPlasticAction::addJoint")
	message(FATAL_ERROR "The interface is not exported:\n${symbols}")
endif()
string(REGEX MATCHALL "[^\n]+\n" lines "${symbols}")
foreach(line IN LISTS lines)
	if(NOT line MATCHES "^[0-9a-f]+ [A-Za-z] (vtable for |typeinfo for |typeinfo name for |non-virtual thunk to )?(btElasticPlastic[A-Z0-9]|btep_)")
		message(FATAL_ERROR "Exported, but no part of the interface: ${line}")
	endif()
endforeach()
set(package bullet-elastic-plastic)
if(precision STREQUAL double)
	string(APPEND package -float64)
endif()
find_program(make NAMES gmake make REQUIRED)
run("${CMAKE_COMMAND}" -E env "PKG_CONFIG_PATH=${prefix}/lib/pkgconfig" "CXX=${compiler}" "CXXFLAGS=${flags}"
	"LDFLAGS=-Wl,-rpath,${prefix}/lib" ${make} -s -f "${sources}/Makefile" "PACKAGE=${package}" "SOURCE=${sources}/game/after.cpp"
	"OUTPUT=${work}/after")
expect("${work}/after" "bent by -0.1[0-9] rad")

# The interface in C, from C and from C#.
find_program(cc NAMES cc gcc clang)
if(cc)
	run(${cc} -std=c99 -Wall -Wextra -pedantic -Werror "-I${prefix}/include/bullet-elastic-plastic" "${sources}/c/sample.c" "${library}"
		"-Wl,-rpath,${prefix}/lib" -o "${work}/sample")
	expect("${work}/sample" "0.329 s: event 1 of joint 3, 401[0-9] J")
endif()
find_program(mcs mcs)
find_program(mono mono)
if(mcs AND mono AND precision STREQUAL float)
	run(${mcs} -warnaserror -out:${work}/Sample.exe "${sources}/csharp/Sample.cs")
	execute_process(COMMAND "${CMAKE_COMMAND}" -E env "LD_LIBRARY_PATH=${prefix}/lib" ${mono} "${work}/Sample.exe" OUTPUT_VARIABLE output
		COMMAND_ERROR_IS_FATAL ANY)
	if(NOT output MATCHES "0.329 s: event 1 of joint 3")
		message(FATAL_ERROR "The sample in C# tells:\n${output}")
	endif()
else()
	message(STATUS "The sample in C# is left out: it needs Bullet in float, and mcs and mono (Debian and Ubuntu: mono-mcs, mono-runtime)")
endif()
