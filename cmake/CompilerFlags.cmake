# SPDX-License-Identifier: GPL-2.0-or-later
# Flags common to the kernel, the plugin and the C++ tests.

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

# Reproducible results: no fused multiply-add behind the source's back, no -ffast-math. Neither errno nor floating-point traps are used: dropping them changes no number.
add_compile_options(-Wall -Wextra -ffp-contract=off -fno-math-errno -fno-trapping-math)
# What GCC makes of three neighbouring numbers by itself costs more than it gains: a fifth of the sweeps' time. pkg/kernel/simd.hpp says where vectors pay.
add_compile_options(-fno-tree-slp-vectorize)

# Processors of level x86-64-v3 (AVX2) take four numbers at a time instead of two (pkg/kernel/simd.hpp), with the same results to the last bit. A module
# built so is refused by the loader of a machine that has no such processor.
include(CheckCXXCompilerFlag)
include(CheckCXXSourceRuns)
check_cxx_compiler_flag(-march=x86-64-v3 TIMBER_KNOWS_X86_64_V3) # not on other architectures
check_cxx_source_runs("int main() { return __builtin_cpu_supports(\"avx2\") && __builtin_cpu_supports(\"bmi2\") ? 0 : 1; }" TIMBER_HAS_X86_64_V3)
option(TIMBER_X86_64_V3 "Build for processors of level x86-64-v3" ${TIMBER_HAS_X86_64_V3})
option(TIMBER_SECOND_MODULE "Build a second module, for processors of level x86-64-v3, which takes the place of the first one where it can" OFF)

# Compile a target, and what links to it, for processors of level x86-64-v3.
function(timber_use_x86_64_v3 target)
  target_compile_options(${target} PUBLIC -march=x86-64-v3 -mno-fma) # GCC 12 makes fmaddsub of neighbouring lanes whatever -ffp-contract says
  target_link_options(${target} PUBLIC -Wl,-z,x86-64-v3)
endfunction()

add_compile_options(-Wno-psabi) # functions that return vectors are inlined

if(TIMBER_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

if(TIMBER_FUZZ) # vectors check their indices
  add_compile_options(-fsanitize=fuzzer-no-link)
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
endif()

find_program(TIMBER_CCACHE ccache)
if(TIMBER_CCACHE)
  # Precompiled headers defeat ccache unless their time stamps may be ignored. Clones share the cache: paths are relative.
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
      CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${TIMBER_CCACHE})
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endif()

# Eigen types cross the boundary between kernel and YADE, so both sides must agree on alignment and vectorisation.
add_library(timber_eigen_abi INTERFACE)
target_compile_definitions(timber_eigen_abi INTERFACE EIGEN_DONT_VECTORIZE EIGEN_DONT_ALIGN EIGEN_DISABLE_UNALIGNED_ARRAY_ASSERT)
