# One target per folder: dovetail_library(NAME BASE dir SOURCES ... HEADERS ... LINK ... [PRIVATE_LINK ...]).
# Headers are included by their path below BASE ("contact/march.hpp", "geometry/profile/profile.hpp").
add_library(dovetail_warnings INTERFACE)
target_compile_options(dovetail_warnings INTERFACE -Wall -Wextra -Wconversion -Wshadow)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 reports std::string concatenation as overlapping copies (GCC bug 105651).
  # At -O1 it takes temporaries of Eigen and of <regex> for uninitialised; release builds keep the check.
  target_compile_options(dovetail_warnings INTERFACE -Wno-restrict $<$<CONFIG:RelWithDebInfo>:-Wno-maybe-uninitialized>)
  if(DOVETAIL_PRECOMPILE)
    # The same bug: precompiled, libstdc++ does not count as a system header in these.
    target_compile_options(dovetail_warnings INTERFACE -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
  endif()
endif()
if(DOVETAIL_WERROR)
  target_compile_options(dovetail_warnings INTERFACE -Werror)
endif()
if(DOVETAIL_SANITIZE)
  # Without the checks whose errors the address sanitiser or the processor reports as well: they double the time and
  # memory that compiling Eigen takes, and vptr rejects handles of CGAL's arrangements.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize=null,object-size,alignment,vptr
    -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  # Under the sanitiser Eigen aligns memory itself and hides a pointer before it. Matrices that pagmo's library, built
  # without, has made would be freed the other way. malloc aligns to what Eigen needs here.
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()

# Headers that most files read, precompiled once for the libraries and once for the tests: a third of the time of a
# build. The preset dev builds without, so that an include that is missing shows, and for clang-tidy, which cannot read
# what g++ precompiles.
function(dovetail_precompiled target)
  cmake_parse_arguments(ARG "" "" "HEADERS;LINK" ${ARGN})
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/${target}.cpp CONTENT "")
  add_library(${target} OBJECT EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/${target}.cpp)
  target_link_libraries(${target} PRIVATE dovetail_warnings ${ARG_LINK})
  target_compile_features(${target} PRIVATE cxx_std_20)
  target_precompile_headers(${target} PRIVATE ${ARG_HEADERS})
endfunction()
if(DOVETAIL_PRECOMPILE)
  set(standard <algorithm> <array> <cmath> <complex> <functional> <map> <memory> <numbers> <numeric> <optional> <span>
    <string> <string_view> <vector>)
  dovetail_precompiled(dovetail_precompiled LINK Eigen3::Eigen HEADERS <Eigen/Core> <Eigen/SparseCore> ${standard})
  set_target_properties(dovetail_precompiled PROPERTIES POSITION_INDEPENDENT_CODE ON)
  if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache$")
    # What ccache asks for to keep objects made with precompiled headers.
    add_compile_options(-fpch-preprocess)
    list(PREPEND CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros)
  endif()
endif()

# Headers and templates are read once for five files; a file that cannot share names with its neighbours says
# SKIP_UNITY_BUILD_INCLUSION. Libraries share the precompiled headers, too.
function(dovetail_together)
  if(NOT DOVETAIL_PRECOMPILE)
    return()
  endif()
  foreach(target ${ARGN})
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 5)
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "STATIC_LIBRARY")
      set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
      target_precompile_headers(${target} REUSE_FROM dovetail_precompiled)
    endif()
  endforeach()
endfunction()

function(dovetail_library name)
  cmake_parse_arguments(ARG "" "BASE" "SOURCES;HEADERS;LINK;PRIVATE_LINK" ${ARGN})
  set(target dovetail_${name})
  if(ARG_SOURCES)
    add_library(${target} STATIC ${ARG_SOURCES})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:dovetail_warnings> ${ARG_PRIVATE_LINK})
    target_compile_features(${target} PUBLIC cxx_std_20)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    dovetail_together(${target})
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
    target_compile_features(${target} INTERFACE cxx_std_20)
  endif()
  target_link_libraries(${target} ${scope} ${ARG_LINK})
  target_sources(${target} ${scope} FILE_SET HEADERS BASE_DIRS ${ARG_BASE} FILES ${ARG_HEADERS})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  add_library(dovetail::${name} ALIAS ${target})
  set_property(GLOBAL APPEND PROPERTY DOVETAIL_TARGETS ${target})
endfunction()

# A program that tests of a label run; all of them: cmake --build --preset ... --target tests_unit
function(dovetail_tests_need label program)
  if(NOT TARGET tests_${label})
    add_custom_target(tests_${label})
  endif()
  add_dependencies(tests_${label} ${program})
endfunction()

# One test program per folder of tests: dovetail_test(NAME LABEL label SOURCES ... LINK ...).
function(dovetail_test name)
  cmake_parse_arguments(ARG "" "LABEL" "SOURCES;LINK" ${ARGN})
  if(NOT DOVETAIL_BUILD_TESTS)
    return()
  endif()
  if(NOT TARGET dovetail_test_main)
    add_library(dovetail_test_main OBJECT ${PROJECT_SOURCE_DIR}/tests/main.cpp)
    target_link_libraries(dovetail_test_main PRIVATE dovetail_warnings PUBLIC dovetail::numerics GTest::gmock)
    target_include_directories(dovetail_test_main PRIVATE ${PROJECT_SOURCE_DIR})
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE dovetail_warnings ${ARG_LINK} dovetail_test_main)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  if(DOVETAIL_PRECOMPILE)
    if(NOT TARGET dovetail_precompiled_tests)
      dovetail_precompiled(dovetail_precompiled_tests LINK Eigen3::Eigen GTest::gmock
        HEADERS <gmock/gmock.h> <gtest/gtest.h> <Eigen/Dense> <Eigen/SparseCore> ${standard})
    endif()
    target_precompile_headers(${name} REUSE_FROM dovetail_precompiled_tests)
    set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 5)
  endif()
  dovetail_tests_need(${ARG_LABEL} ${name})
  include(GoogleTest)
  # Tests run side by side: threads of OpenBLAS within each would only slow the others down.
  set(environment ENVIRONMENT OPENBLAS_NUM_THREADS=1)
  if(DOVETAIL_SANITIZE)
    list(APPEND environment
      ENVIRONMENT_MODIFICATION LSAN_OPTIONS=set:suppressions=${PROJECT_SOURCE_DIR}/.cmake/leaks.txt)
  endif()
  gtest_discover_tests(${name}
    NO_PRETTY_VALUES  # bytes of a parameter without a printer are no name
    PROPERTIES LABELS ${ARG_LABEL} ${environment}
    DISCOVERY_TIMEOUT 60)
endfunction()

# Files of text as constants of the header FOLDER/texts.hpp, dovetail::NAMESPACE::texts::page_css for page.css:
# dovetail_texts(TARGET FOLDER NAMESPACE file...).
function(dovetail_texts target folder namespace)
  set(header "#pragma once\n\n#include <string_view>\n\nnamespace dovetail::${namespace}::texts {\nusing std::literals::operator\"\"sv;\n")
  foreach(file ${ARGN})
    file(READ ${file} text)
    get_filename_component(name ${file} NAME)
    string(MAKE_C_IDENTIFIER ${name} name)
    string(APPEND header "inline constexpr std::string_view ${name} = R\"text(${text})text\"sv;\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  endforeach()
  set(place ${CMAKE_CURRENT_BINARY_DIR}/texts)
  file(CONFIGURE OUTPUT ${place}/${folder}/texts.hpp CONTENT "${header}}\n" @ONLY)
  target_include_directories(${target} PRIVATE ${place})
endfunction()
