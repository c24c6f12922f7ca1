# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

# The examples' programs, which take long (Long.cmake): by their classes, from outside, and their windows, of which pictures are looked at.

if(EP_WITH_VIEWER)
	find_package(PNG REQUIRED)
	foreach(tool IN ITEMS checkPicture pictureShare)
		add_executable(${tool} programs/${tool}.cpp)
		_ep_compile(${tool})
		target_link_libraries(${tool} PRIVATE PNG::PNG)
	endforeach()
endif()

# Runs the program for the given seconds and looks at the picture of its window. The vehicle has at least so many per cent of it.
function(ep_add_picture_test name program seconds vehicle)
	if(TARGET ${program} AND EP_WITH_VIEWER)
		set(picture ${CMAKE_CURRENT_BINARY_DIR}/${name}.png)
		list(JOIN ARGN " " arguments)
		ep_add_window_test(${name} COMMAND sh -c
			"$<TARGET_FILE:${program}> ${arguments} --screenshot ${picture} --after ${seconds} && $<TARGET_FILE:checkPicture> ${picture} ${vehicle}")
	endif()
endfunction()

# What a program must say, called so.
function(ep_must_say name says program)
	add_test(NAME ${name} COMMAND ${program} ${ARGN})
	set_tests_properties(${name} PROPERTIES PASS_REGULAR_EXPRESSION "${says}" ${EP_OF_DRAWING_TESTS})
endfunction()

# ---- what they share
ep_add_test(tests-effects SOURCES programs/testEffects.cpp LINK ElasticPlasticEffects ONE_PRECISION ${EP_LABEL})
if(EP_WITH_PICTURES)
	ep_add_test(tests-picture SOURCES programs/testPicture.cpp LINK ElasticPlasticPicture DRAWS ONE_PRECISION ${EP_LABEL})
endif()
if(EP_WITH_VIEWER)
	ep_add_test(tests-sound SOURCES programs/testSound.cpp LINK ElasticPlasticSound ONE_PRECISION ${EP_LABEL})
endif()

# ---- Charpy test
if(TARGET ElasticPlasticCharpy OR TARGET ElasticPlasticCharpy-float64)
	file(GLOB sources CONFIGURE_DEPENDS programs/testCharpy*.cpp)
	ep_add_test(tests-charpy SOURCES ${sources} LINK ElasticPlasticCharpy nlohmann_json::nlohmann_json ${EP_LABEL})
	ep_add_picture_test(Charpy.window charpy 2 0)
endif()
if(TARGET charpy)
	set(out ${CMAKE_CURRENT_BINARY_DIR}/charpy)
	add_test(NAME Charpy.tableXI COMMAND charpy --study table-xi --out ${out})
	ep_must_say(Charpy.headless "passed: loss 14[0-9]" charpy --headless --dt 0.1 --joint ep2 --friction 0.1 --out ${out})
	# Bad input is named, with what would be good.
	ep_must_say(Charpy.unknownJoint "--joint.*glue.*ep2" charpy --joint glue --out ${out})
	ep_must_say(Charpy.notANumber "--friction.*nan.*0 to 2" charpy --friction nan --out ${out})
	ep_must_say(Charpy.negative "--dt.*-1.*0.0001 to 5" charpy --dt -1 --out ${out})
	ep_must_say(Charpy.unwritable "cannot make the directory '/dev/null/x' \\(--out\\)" charpy --out /dev/null/x)
endif()

# ---- demolisher
if(TARGET demolisher)
	file(GLOB sources CONFIGURE_DEPENDS programs/testDemolisher*.cpp)
	ep_add_test(tests-demolisher SOURCES ${sources} LINK ElasticPlasticDemolisher nlohmann_json::nlohmann_json ONE_PRECISION
		${EP_LABEL} COST ${EP_LONG})
	ep_add_picture_test(Demolisher.window demolisher 9 0.5)
	set(out ${CMAKE_CURRENT_BINARY_DIR}/demolisher)
	add_test(NAME Demolisher.headless COMMAND demolisher --headless --scene bridge --seconds 20
		--autopilot ${PROJECT_SOURCE_DIR}/examples/Demolisher/routes/back-and-forth.json --out ${out}/headless)
	add_test(NAME Demolisher.figure11 COMMAND demolisher --figure-11 --out ${out}/figure11)
	set_tests_properties(Demolisher.headless Demolisher.figure11 PROPERTIES ${EP_OF_DRAWING_TESTS})
	function(ep_demolisher_must_say name says)
		ep_must_say(Demolisher.${name} "${says}" demolisher ${ARGN} --headless --out ${out}/${name})
	endfunction()
	ep_demolisher_must_say(list "gate.*fence.*bridge.*rod.*none.*rigid.*ep2-paper.*stock.*direct" --list)
	ep_demolisher_must_say(unknownScene "--scene.*tower.*gate.*rod.*all" --scene tower)
	ep_demolisher_must_say(unknownJoint "--joint.*glue.*none.*ep2-paper" --joint glue)
	ep_demolisher_must_say(unknownSolver "--solver.*magic.*stock.*direct" --solver magic)
	ep_demolisher_must_say(unknownOption "--towers" --towers 3)
	ep_demolisher_must_say(notANumber "--steel-share.*nan.*0.0001 to 1" --steel-share nan)
	ep_demolisher_must_say(noFile "autopilot's file 'nowhere.json' \\(--autopilot\\).*is it there" --autopilot nowhere.json)
	file(WRITE ${out}/bad.json "{\"legs\": [{\"to_x_m\": 60, \"haste\": 3}]}")
	ep_demolisher_must_say(unknownKey "bad.json.*leg 1.*haste.*to_x_m, speed_m_s, stop, wait_s" --autopilot ${out}/bad.json)
	ep_demolisher_must_say(directoryAsRoute "autopilot's file.*cannot be read: is it there, a file" --autopilot ${out})
	string(REPEAT "[" 100000 deep)
	file(WRITE ${out}/deep.json "${deep}")
	ep_demolisher_must_say(deepRoute "deep.json.*more than 16 levels deep" --autopilot ${out}/deep.json)
	string(REPEAT "<long>" 10000 long)
	file(WRITE ${out}/long.json "{\"legs\": [{\"to_x_m\": \"${long}\"}]}")
	ep_demolisher_must_say(longValue "long.json' [^\n]*leg 1: to_x_m is \"[long<>]+\\.\\.\\.\"; it must be a number from -5000.0 to 5000.0\n"
		--autopilot ${out}/long.json)
	file(WRITE ${out}/list.json "{\"legs\": [{\"to_x_m\": [1, [2, 3]]}]}")
	ep_demolisher_must_say(listAsNumber "list.json.*to_x_m is a list of 2; it must be a number" --autopilot ${out}/list.json)
	ep_demolisher_must_say(filmWithoutWindow "--record.*window.*--headless" --record film.mp4)
	ep_demolisher_must_say(speedBeyondTheWay "--speed asks for 26.0 m/s; on the way to the gate the vehicle comes to 1[0-9].[0-9] m/s"
		--scene gate --speed 26 --seconds 8)
	ep_demolisher_must_say(limitsOfRanges "summary.json" --steel-share 0.0001 --ductility 0.0001 --step 0.1 --seconds 0.2)
	ep_must_say(Demolisher.unwritable "cannot make the directory '/dev/null/x' \\(--out\\)" demolisher --headless --out /dev/null/x)

	# Its window, used by keys and mouse.
	find_program(XDOTOOL xdotool)
	if(NOT XDOTOOL)
		message(STATUS "Demolisher.keysAndMouse: xdotool not found, left out")
	elseif(EP_WITH_VIEWER)
		ep_add_window_test(Demolisher.keysAndMouse COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/programs/useDemolisher
			$<TARGET_FILE:demolisher> $<TARGET_FILE:pictureShare> ${CMAKE_CURRENT_BINARY_DIR}/use-demolisher)
		if(TEST Demolisher.keysAndMouse)
			# A window without graphics card keeps two cores busy.
			set_tests_properties(Demolisher.keysAndMouse PROPERTIES PROCESSORS 2 TIMEOUT 900 COST ${EP_LONG})
		endif()
	endif()
endif()

# ---- viewer
if(TARGET ep-view)
	ep_add_picture_test(Problem.window ep-view 1 0 dropped-mass --rate 240)
	ep_add_picture_test(Trial.window ep-view 0.1 0 "'all at once/all yield'")
	if(EP_WITH_SCENE_FILES)
		ep_add_picture_test(SceneFile.window ep-view 1 0 ${PROJECT_SOURCE_DIR}/examples/scenes/column-loss.json)
	endif()
	ep_add_picture_test(Destruction.window ep-view 2 0 weak-frame)
	ep_must_say(Trial.list "dropped-mass.*wall-hit.*all at once/all yield" ep-view --list)
	ep_must_say(Trial.unknown "no problem, scene or trial 'nothing'.*--list" ep-view nothing)
endif()
if(TARGET ElasticPlasticSamples OR TARGET ElasticPlasticSamples-float64)
	ep_add_test(tests-samples SOURCES programs/testSamples.cpp programs/testQuality.cpp LINK ElasticPlasticSamples DRAWS ONE_PRECISION ${EP_LABEL})
endif()

# ---- report
if(TARGET ep-report)
	# A program that is run as it is: in one precision, it runs those that there are.
	add_executable(tests-report programs/testReport.cpp programs/testJudgement.cpp)
	_ep_compile(tests-report)
	list(GET EP_PRECISIONS 0 precision)
	target_link_libraries(tests-report PRIVATE ReportJudge${EP_SUFFIX_${precision}} GTest::gtest_main)
	target_compile_definitions(tests-report PRIVATE EP_REPORT="$<TARGET_FILE:ep-report>" $<$<BOOL:${EP_WITH_PICTURES}>:EP_WITH_PICTURES>)
	ep_add_suites(tests-report "" LABELS long ${EP_OF_DRAWING_TESTS})
endif()
if(TARGET EpOde)
	ep_add_test(tests-ode SOURCES programs/testOde.cpp LINK ReportCompute nlohmann_json::nlohmann_json ${EP_LABEL})
	foreach(precision IN LISTS EP_PRECISIONS)
		target_compile_definitions(tests-ode-${precision} PRIVATE
			EP_REPORT_CASE="$<TARGET_FILE:ep-report-case${EP_SUFFIX_${precision}}>")
	endforeach()
endif()
