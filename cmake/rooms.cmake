# A room is one folder under src/conchoid: one static library that sees only the rooms it names.
# Compiler settings are the same for every file: mixing -march between files breaks inline code shared by both.

add_library(conchoid_settings INTERFACE)
target_compile_features(conchoid_settings INTERFACE cxx_std_20)
target_include_directories(conchoid_settings INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                                                       $<INSTALL_INTERFACE:include>)
# Where a program that is linked with the library looks for its modules (core/module.hpp): the build's own are told by
# CMAKE_BUILD_RPATH, ours when installed by INSTALL_RPATH.
target_link_options(conchoid_settings INTERFACE
  $<INSTALL_INTERFACE:-Wl,-rpath,$<INSTALL_PREFIX>/${CMAKE_INSTALL_LIBDIR}/conchoid>)
# No contraction of a*b+c into fused operations: the same bits whatever the compiler inlines.
target_compile_options(conchoid_settings INTERFACE
  $<BUILD_INTERFACE:-Wall -Wextra -Wpedantic -ffp-contract=off>)
# g++ 12 sees an overlap in "text" + std::string where there is none (gcc bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(conchoid_settings INTERFACE $<BUILD_INTERFACE:-Wno-restrict>)
endif()
if(CONCHOID_NATIVE)
  target_compile_options(conchoid_settings INTERFACE $<BUILD_INTERFACE:-march=native>)
endif()
if(CONCHOID_SANITIZE)
  target_compile_options(conchoid_settings INTERFACE
    $<BUILD_INTERFACE:-fsanitize=${CONCHOID_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all>)
  target_link_options(conchoid_settings INTERFACE -fsanitize=${CONCHOID_SANITIZE})
endif()

# conchoid_optimization(TARGET LEVEL): the optimization of release builds, in place of CMake's -O3, where speed is elsewhere.
function(conchoid_optimization target level)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${level}>)
endfunction()

# conchoid_precompile(NAME PIC ON|OFF OPTIMIZATION level LIBRARIES external targets HEADERS further headers)
# Half of the time to compile a file goes into headers from outside the project. These are compiled once for all rooms and
# once for all tests; others take them by target_precompile_headers(… REUSE_FROM NAME). None of our own is among them: a
# change of ours never rebuilds everything. Nothing of this is installed.
function(conchoid_precompile name)
  cmake_parse_arguments(PRE "" "PIC;OPTIMIZATION" "LIBRARIES;HEADERS" ${ARGN})
  if(NOT CONCHOID_PCH)
    return()
  endif()
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp CONTENT "")
  add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ${PRE_PIC})
  target_link_libraries(${name} PRIVATE conchoid_settings Eigen3::Eigen ${PRE_LIBRARIES})
  if(PRE_OPTIMIZATION)
    conchoid_optimization(${name} ${PRE_OPTIMIZATION})
  endif()
  target_precompile_headers(${name} PRIVATE
    <Eigen/Core> <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional>
    <limits> <map> <memory> <numbers> <numeric> <optional> <random> <set> <span> <sstream> <string> <string_view>
    <unordered_map> <utility> <vector> ${PRE_HEADERS})
endfunction()

function(conchoid_use_precompiled target name)
  if(CONCHOID_PCH)
    target_precompile_headers(${target} REUSE_FROM ${name})
  endif()
endfunction()

# conchoid_choose(OPTION WITH files WITHOUT files): the rooms and tests that follow in this folder leave out the ones or the
# others, as OPTION is off or on.
function(conchoid_choose option)
  cmake_parse_arguments(CHOICE "" "" "WITH;WITHOUT" ${ARGN})
  if(${option})
    set(left_out ${CHOICE_WITHOUT})
  else()
    set(left_out ${CHOICE_WITH})
  endif()
  list(TRANSFORM left_out PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  set(CONCHOID_LEFT_OUT ${CONCHOID_LEFT_OUT} ${left_out} PARENT_SCOPE)
endfunction()

# conchoid_room(NAME USES rooms... LIBRARIES external targets seen by users LIBRARIES_PRIVATE external targets hidden inside)
# COLD the time is spent elsewhere: compiled with less optimization, which takes two thirds of the time.
# FLAGS compiler flags of this room's own: they rule out the precompiled headers that the others share.
function(conchoid_room name)
  cmake_parse_arguments(ROOM "COLD" "" "FLAGS;USES;LIBRARIES;LIBRARIES_PRIVATE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(REMOVE_ITEM sources ${CONCHOID_LEFT_OUT})
  add_library(conchoid_${name} STATIC ${sources})
  set_target_properties(conchoid_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  list(TRANSFORM ROOM_USES PREPEND conchoid_)
  target_link_libraries(conchoid_${name} PUBLIC conchoid_settings ${ROOM_USES} ${ROOM_LIBRARIES}
                                         PRIVATE ${ROOM_LIBRARIES_PRIVATE})
  set_property(GLOBAL APPEND PROPERTY CONCHOID_ROOMS conchoid_${name})
  if(ROOM_FLAGS)
    target_compile_options(conchoid_${name} PRIVATE ${ROOM_FLAGS})
  elseif(ROOM_COLD)
    conchoid_optimization(conchoid_${name} -O1)
    conchoid_use_precompiled(conchoid_${name} conchoid_cold_room_headers)
  else()
    conchoid_use_precompiled(conchoid_${name} conchoid_room_headers)
  endif()
endfunction()

# conchoid_module(NAME IF OPTION SOURCE file USES rooms whose code it takes a copy of LIBRARIES external targets)
# One file of a room as a shared object of its own, loaded on first use (core/module.hpp). The room itself leaves it out, and
# is told by this call, which comes first. In the build folder all lie in modules/, installed in lib/conchoid/.
add_custom_target(conchoid_modules)
function(conchoid_module name)
  cmake_parse_arguments(MODULE "" "IF;SOURCE" "USES;LIBRARIES" ${ARGN})
  set(CONCHOID_LEFT_OUT ${CONCHOID_LEFT_OUT} ${CMAKE_CURRENT_SOURCE_DIR}/${MODULE_SOURCE} PARENT_SCOPE)
  if(NOT ${MODULE_IF})
    file(REMOVE ${CONCHOID_MODULE_FOLDER}/${name}.so)  # of a build before
    return()
  endif()
  add_library(${name} MODULE ${MODULE_SOURCE} ${PROJECT_BINARY_DIR}/module_version.cpp)
  list(TRANSFORM MODULE_USES PREPEND conchoid_)
  target_link_libraries(${name} PRIVATE conchoid_settings ${MODULE_USES} ${MODULE_LIBRARIES})
  target_link_options(${name} PRIVATE LINKER:--exclude-libs,ALL)
  set_target_properties(${name} PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${CONCHOID_MODULE_FOLDER}
                                           INSTALL_RPATH_USE_LINK_PATH ON)
  add_dependencies(conchoid_modules ${name})
  install(TARGETS ${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/conchoid)
endfunction()

# conchoid_test(NAME USES rooms... LIBRARIES external targets): tests/NAME/*.cpp become the program test_NAME.
function(conchoid_test name)
  cmake_parse_arguments(TEST "" "" "USES;LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  list(REMOVE_ITEM sources ${CONCHOID_LEFT_OUT})
  add_executable(test_${name} ${sources})
  list(TRANSFORM TEST_USES PREPEND conchoid_)
  target_link_libraries(test_${name} PRIVATE conchoid_settings ${TEST_USES} ${TEST_LIBRARIES} GTest::gtest_main)
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(test_${name} PRIVATE
    CONCHOID_SOURCE_DIR="${PROJECT_SOURCE_DIR}" CONCHOID_BINARY="$<TARGET_FILE:conchoid>"
    CONCHOID_SHARED_MODELS="${PROJECT_SOURCE_DIR}/../shared/models")
  conchoid_optimization(test_${name} -O1)
  conchoid_use_precompiled(test_${name} conchoid_test_headers)
  add_dependencies(test_${name} conchoid_modules)
  gtest_discover_tests(test_${name} DISCOVERY_TIMEOUT 120 PROPERTIES TIMEOUT 1200)
endfunction()
