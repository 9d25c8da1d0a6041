# Build settings shared by all targets; only the language level is global.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

option(FASTSPLAT_WERROR "Warnings are errors (set by the ci preset only: a newer compiler must not break a user's build)" OFF)
option(FASTSPLAT_TESTS "Tests, examples and benchmarks; need the packages of [tests] in tools/debian.txt" ON)
option(FASTSPLAT_PEERS "Programs that race other renderers (tools/benchmarks/peers): tools/peers" OFF)
option(FASTSPLAT_UNITY "Compile the libraries' sources sixteen at a time; off: one by one, for who edits them" ON)
option(FASTSPLAT_ASAN "AddressSanitizer and UndefinedBehaviorSanitizer" OFF)
option(FASTSPLAT_FUZZ "The fuzz targets of tests/fuzz and all they call, under libFuzzer and the sanitizers; needs Clang" OFF)

find_program(FASTSPLAT_CCACHE ccache)
if(FASTSPLAT_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # ccache requires this sloppiness to cache anything with precompiled headers.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${FASTSPLAT_CCACHE})
endif()

# Warnings, sanitizers and the include root; all first-party targets link it.
add_library(fastsplat_settings INTERFACE)
target_include_directories(fastsplat_settings INTERFACE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/generated)
target_compile_options(fastsplat_settings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 warns falsely about "literal" + std::string (GCC bug 105651).
  target_compile_options(fastsplat_settings INTERFACE -Wno-restrict)
endif()
if(FASTSPLAT_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # In a unity build it warns about every class, because the sources are included files.
  target_compile_options(fastsplat_settings INTERFACE -Wno-subobject-linkage)
endif()
if(FASTSPLAT_WERROR)
  target_compile_options(fastsplat_settings INTERFACE -Werror)
endif()
if(FASTSPLAT_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "FASTSPLAT_FUZZ requires Clang, which provides libFuzzer: set CMAKE_CXX_COMPILER=clang++")
  endif()
  target_compile_options(fastsplat_settings INTERFACE -fsanitize=fuzzer-no-link)
endif()
if(FASTSPLAT_ASAN)
  target_compile_options(fastsplat_settings INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(fastsplat_settings INTERFACE -fsanitize=address,undefined)
endif()

# Floating-point code: no contraction, so that each operation is rounded once, as written. The C library's exp, erf and
# similar functions may still differ in the last bit between processors (docs/decisions.md, 28).
add_library(fastsplat_strict_float INTERFACE)
target_compile_options(fastsplat_strict_float INTERFACE -ffp-contract=off)

# fastsplat_library(<name> [FOLDERS <sub-folders...>] DEPENDS <targets...>): builds libfastsplat_<name> from all .cpp of
# the folder and of the named sub-folders.
function(fastsplat_library name)
  cmake_parse_arguments(arg "" "" "FOLDERS;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  list(TRANSFORM arg_FOLDERS REPLACE "(.+)" "${CMAKE_CURRENT_SOURCE_DIR}/\\1/*.cpp")
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp ${arg_FOLDERS})
  add_library(fastsplat_${name} STATIC ${sources})
  # Compiles sixteen sources as one, because headers and their templates dominate compile time. Vector kernels stay
  # separate: Highway includes them once per instruction set.
  foreach(source ${sources})
    file(STRINGS ${source} kernel REGEX "define HWY_TARGET_INCLUDE")
    if(kernel)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
  set_target_properties(fastsplat_${name} PROPERTIES UNITY_BUILD ${FASTSPLAT_UNITY} UNITY_BUILD_BATCH_SIZE 16)
  target_link_libraries(fastsplat_${name} PUBLIC fastsplat_settings ${arg_DEPENDS} PRIVATE ${arg_PRIVATE_DEPENDS})
endfunction()

# fastsplat_shareable(<libraries...>): libraries that libfastsplat (testbench/capi/) may link as well. Symbols are hidden, because
# otherwise the compiler could not inline functions that another library may replace.
function(fastsplat_shareable)
  set_target_properties(${ARGN} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
endfunction()
