# Compile flags that every target of the project shares.
#
# Results must have the same bits for any thread count and on any machine that runs the same binary, so the
# compiler may not contract a*b+c into one rounding (-ffp-contract=off) and -ffast-math stays away. The two
# flags below change no result: the code neither reads errno after a math call nor traps on exceptions.
add_library(galet_flags INTERFACE)
target_compile_options(galet_flags INTERFACE
  -ffp-contract=off -fno-math-errno -fno-trapping-math
  # -Wrestrict reports string concatenation falsely in GCC 12 (bug 105651).
  -Wall -Wextra -Wpedantic -Wshadow -Wno-psabi $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
if(CMAKE_UNITY_BUILD)
  # Most of a compilation is what Eigen's expressions make of themselves, again in each file: few large files take a third
  # less than many. Two cores need no more than two or three of a target.
  if(NOT DEFINED CMAKE_UNITY_BUILD_BATCH_SIZE)
    set(CMAKE_UNITY_BUILD_BATCH_SIZE 40)
  endif()
  # Types of a source's unnamed namespace look to GCC as if a header held them, its constants as those of other sources.
  target_compile_options(galet_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage> -Wno-shadow)
  # Files this large make GCC collect its garbage over and over: a tenth of the time against half a gigabyte.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(galet_flags INTERFACE --param=ggc-min-heapsize=1000000)
  endif()
endif()
if(GALET_VALIDATE)
  target_compile_definitions(galet_flags INTERFACE GALET_VALIDATE=1)
endif()
if(GALET_SANITIZE)
  # Without -fno-sanitize-recover the undefined-behaviour sanitizer only prints, and a test that it speaks in passes.
  target_compile_options(galet_flags INTERFACE
    -fsanitize=${GALET_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
    # Null pointers stop a run by themselves and Eigen asserts alignment: their checks cost a fifth of the build. What
    # the checks of object sizes and of pointers that wrap would find, the address sanitizer finds at the access: they
    # cost a seventh.
    -fno-sanitize=null,alignment,object-size,pointer-overflow)
  target_link_options(galet_flags INTERFACE -fsanitize=${GALET_SANITIZE})
endif()
if(GALET_COVERAGE)
  target_compile_options(galet_flags INTERFACE --coverage)
  target_link_options(galet_flags INTERFACE --coverage)
endif()

# Headers that nearly every file of a target includes, compiled once for it: a third of the time of the smaller files. (As
# long as a target has many files: where several are compiled as one, reading the headers once more is cheaper.)
set(GALET_COMMON_HEADERS <Eigen/Core> <Eigen/Geometry> <Eigen/LU> <fmt/format.h> <algorithm> <array> <cmath>
    <functional> <map> <memory> <numeric> <optional> <span> <string> <vector>)

# galet_precompile(TARGET HEADERS...)
function(galet_precompile target)
  if(NOT CMAKE_UNITY_BUILD)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# galet_library(NAME DEPENDS...): one of the project's libraries, built from every .cpp file below this folder.
function(galet_library name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$|/commands/")
  if(NOT GALET_BUILD_STUDIES)
    list(FILTER sources EXCLUDE REGEX "/src/studies/|/src/verify/")
  endif()
  add_library(galet_${name} ${sources})
  add_library(galet::${name} ALIAS galet_${name})
  set_target_properties(galet_${name} PROPERTIES EXPORT_NAME ${name} OUTPUT_NAME galet_${name})
  target_include_directories(galet_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/galet>)
  target_link_libraries(galet_${name} PUBLIC ${ARGN} PRIVATE $<BUILD_INTERFACE:galet_flags>)
  target_compile_features(galet_${name} PUBLIC cxx_std_20)
  galet_precompile(galet_${name} ${GALET_COMMON_HEADERS})
  # The largest files, each a target's longest compilation already.
  set_source_files_properties(instances.cpp solver_instances.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# Kernels are compiled once per instruction set (common/core/instructions.hpp): GALET_SETS has those of this build.
include(CheckCXXCompilerFlag)
# -mprfchw: a line that is fetched to be written must not come as one that others may keep. (Processors without that
# instruction do nothing in its place.)
set(GALET_SET_FLAGS_avx2 -mavx2 -mfma -mprfchw)
# GCC 12 takes the operands that its own AVX-512 intrinsics leave open for uninitialised (bug 105593).
set(GALET_SET_FLAGS_avx512 -mavx2 -mfma -mprfchw -mavx512f -mavx512dq -mavx512vl -Wno-maybe-uninitialized)
set(GALET_SETS)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  foreach(set avx2 avx512)
    list(JOIN GALET_SET_FLAGS_${set} " " flags)
    check_cxx_compiler_flag("${flags}" galet_compiles_${set})
    # Sanitizers don't watch kernels of vectors (below): one set is enough for the tests that compare sets.
    if(galet_compiles_${set} AND NOT (GALET_SANITIZE AND set STREQUAL avx512))
      list(APPEND GALET_SETS ${set})
    endif()
  endforeach()
endif()

# galet_name_sets(SOURCE): defines GALET_AVX2 and its kin, of the sets of this build, for a source that chooses.
function(galet_name_sets source)
  foreach(set ${GALET_SETS})
    string(TOUPPER GALET_${set} name)
    set_property(SOURCE ${source} APPEND PROPERTY COMPILE_DEFINITIONS ${name})
  endforeach()
endfunction()

# galet_kernels(): the flags of the present folder's kernel/scalar.cpp, kernel/avx2.cpp and, if there, kernel/avx512.cpp.
function(galet_kernels)
  set(kernels kernel/scalar.cpp)
  galet_name_sets(kernel/dispatch.cpp)
  foreach(set avx2 avx512)
    set(kernel kernel/${set}.cpp)
    if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${kernel})
      continue()
    endif()
    if(set IN_LIST GALET_SETS)
      set_source_files_properties(${kernel} PROPERTIES COMPILE_OPTIONS "${GALET_SET_FLAGS_${set}}")
      list(APPEND kernels ${kernel})
    else()
      set_source_files_properties(${kernel} PROPERTIES HEADER_FILE_ONLY ON)
    endif()
    # Sanitizers need no such speed, and take minutes to compile what was inlined: they watch the scalar build of the
    # same source.
    if(GALET_SANITIZE)
      set_property(SOURCE ${kernel} APPEND PROPERTY COMPILE_OPTIONS "-fno-sanitize=all")
    endif()
  endforeach()
  # A kernel file sees nothing but what it includes (md/kernel/dispatch.hpp says why).
  set_source_files_properties(${kernels} PROPERTIES SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
  # All kernels of one instruction set are one file: without these limits raised GCC stops inlining in the middle of
  # the inner loops.
  if(NOT GALET_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set_property(SOURCE ${kernels} APPEND PROPERTY COMPILE_OPTIONS
      "--param=inline-unit-growth=400;--param=large-function-growth=1000;--param=large-stack-frame-growth=4000")
  endif()
endfunction()
