# The libraries for WebAssembly (preset lab): first-party ones as elsewhere, headers of templates from the Debian packages of
# [demo], C libraries from Debian's sources (tools/helpers/lab_sources), because those of this machine cannot be linked.
set(FASTSPLAT_LAB_SOURCES ${CMAKE_BINARY_DIR}/sources CACHE PATH "Unpacked sources of zlib, bzip2, nifticlib and teem")
set(headers ${CMAKE_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers}/teem)

# Links, because /usr/include itself holds the C library of this machine.
foreach(name fmt glm nlohmann toml++ hwy)
  if(NOT EXISTS /usr/include/${name})
    message(FATAL_ERROR "the lab needs /usr/include/${name}: install the packages of [demo] in tools/debian.txt")
  endif()
  file(CREATE_LINK /usr/include/${name} ${headers}/${name} SYMBOLIC)
endforeach()
add_library(fastsplat_wasm_headers INTERFACE)
target_include_directories(fastsplat_wasm_headers SYSTEM INTERFACE ${headers})
target_compile_definitions(fastsplat_wasm_headers INTERFACE FMT_HEADER_ONLY)
foreach(name fmt::fmt glm::glm nlohmann_json::nlohmann_json PkgConfig::tomlplusplus PkgConfig::hwy)
  add_library(${name} ALIAS fastsplat_wasm_headers)
endforeach()

# fastsplat_wasm_c(<target> <folder> INCLUDE <folders...> SOURCES <patterns...>): a C library.
function(fastsplat_wasm_c target folder)
  cmake_parse_arguments(arg "" "" "INCLUDE;SOURCES" ${ARGN})
  set(folder ${FASTSPLAT_LAB_SOURCES}/${folder})
  if(NOT IS_DIRECTORY ${folder})
    message(FATAL_ERROR "the lab needs the sources in ${folder}: ./run lab fetches them")
  endif()
  list(TRANSFORM arg_SOURCES PREPEND ${folder}/)
  file(GLOB sources ${arg_SOURCES})
  add_library(${target} STATIC ${sources})
  list(TRANSFORM arg_INCLUDE PREPEND ${folder}/)
  target_include_directories(${target} SYSTEM PUBLIC ${arg_INCLUDE})
  target_compile_options(${target} PRIVATE -w)
endfunction()
fastsplat_wasm_c(wasm_zlib zlib INCLUDE .
  SOURCES adler32.c compress.c crc32.c deflate.c inffast.c inflate.c inftrees.c trees.c uncompr.c zutil.c)
fastsplat_wasm_c(wasm_bzip2 bzip2 INCLUDE .
  SOURCES blocksort.c bzlib.c compress.c crctable.c decompress.c huffman.c randtable.c)
fastsplat_wasm_c(wasm_nifti nifticlib INCLUDE nifti2 niftilib znzlib SOURCES nifti2/nifti2_io.c znzlib/znzlib.c)
fastsplat_wasm_c(wasm_teem teem INCLUDE include SOURCES src/air/*.c src/biff/*.c src/hest/*.c src/nrrd/*.c)
add_library(ZLIB::ZLIB ALIAS wasm_zlib)
add_library(BZip2::BZip2 ALIAS wasm_bzip2)
# As teem's own build: all headers in one folder, and what it finds out about the compiler.
file(GLOB teem_headers ${FASTSPLAT_LAB_SOURCES}/teem/src/*/*.h)
foreach(header IN LISTS teem_headers)
  get_filename_component(name ${header} NAME)
  file(CREATE_LINK ${header} ${headers}/teem/${name} SYMBOLIC)
endforeach()
file(WRITE ${headers}/teem/airExistsConf.h "/* The macro works. */\n")
target_include_directories(wasm_teem SYSTEM PUBLIC ${headers})
target_compile_definitions(wasm_teem PRIVATE TEEM_DIO=0 TEEM_QNANHIBIT=1)

# Clang 14 composites red and green behind a layer with the transmittance after it when it vectorises straight-line code.
target_compile_options(fastsplat_settings INTERFACE -msimd128 -fno-slp-vectorize -fwasm-exceptions -include ${PROJECT_SOURCE_DIR}/lab/wasm/libcxx.hpp)
target_link_options(fastsplat_settings INTERFACE -fwasm-exceptions)
