# SPDX-License-Identifier: GPL-2.0-or-later
# The installed YADE and the headers that fit it.
#
# In:   YADE_EXECUTABLE (found on the PATH unless given), YADE_SOURCE_DIR (tree with YADE's headers).
# Out:  target Yade::Yade (headers, definitions, libraries) and
#       YADE_VERSION YADE_FEATURES YADE_LIB_DIR YADE_PYTHON YADE_SITE_DIR YADE_HEADER_VERSION.

find_program(YADE_EXECUTABLE yade)
if(NOT YADE_EXECUTABLE)
  message(FATAL_ERROR "YADE is not installed: no `yade` on the PATH. Run scripts/setup, or give -DYADE_EXECUTABLE=...")
endif()

# --- what the host says of itself -------------------------------------------------------------------------------------
execute_process(
  COMMAND ${YADE_EXECUTABLE} -n -x ${CMAKE_CURRENT_LIST_DIR}/ask_yade.py
  INPUT_FILE /dev/null OUTPUT_VARIABLE yade_answer ERROR_VARIABLE yade_complaint RESULT_VARIABLE yade_status)
if(NOT yade_status EQUAL 0)
  message(FATAL_ERROR "`${YADE_EXECUTABLE} -n -x cmake/ask_yade.py` failed (${yade_status}):\n${yade_complaint}")
endif()
foreach(key VERSION FEATURES LIB_DIR REAL_BITS REAL_DIGITS PYTHON PYTHON_VERSION PYTHON_INCLUDE SITE_DIR)
  if(NOT yade_answer MATCHES "\n@${key}=([^\n]*)")
    message(FATAL_ERROR "YADE did not tell its ${key}; it said:\n${yade_answer}")
  endif()
  set(YADE_${key} "${CMAKE_MATCH_1}")
endforeach()

# --- headers ----------------------------------------------------------------------------------------------------------
if(NOT YADE_SOURCE_DIR)
  file(GLOB yade_trees LIST_DIRECTORIES true ${PROJECT_SOURCE_DIR}/build/yade-source/*/core/Scene.hpp)
  if(yade_trees)
    list(GET yade_trees 0 YADE_SOURCE_DIR)
    get_filename_component(YADE_SOURCE_DIR ${YADE_SOURCE_DIR}/../.. ABSOLUTE)
  endif()
endif()
set(YADE_SOURCE_DIR "${YADE_SOURCE_DIR}" CACHE PATH "YADE source tree whose headers are used")
foreach(file RELEASE core/Scene.hpp lib/factory/ClassFactory.hpp)
  if(NOT EXISTS ${YADE_SOURCE_DIR}/${file})
    message(FATAL_ERROR "YADE_SOURCE_DIR='${YADE_SOURCE_DIR}' is not a YADE source tree (no ${file}). Run scripts/setup, or give -DYADE_SOURCE_DIR=...")
  endif()
endforeach()
file(STRINGS ${YADE_SOURCE_DIR}/RELEASE YADE_HEADER_VERSION LIMIT_COUNT 1)

include(YadeDefinitions)

# --- libraries --------------------------------------------------------------------------------------------------------
string(REPLACE "." "" python_digits ${YADE_PYTHON_VERSION})
find_package(Boost REQUIRED COMPONENTS python${python_digits} serialization iostreams log filesystem thread regex)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_library(YADE_PYTHON_LIBRARY python${YADE_PYTHON_VERSION} REQUIRED)
find_library(YADE_CORE_LIBRARY yade PATHS ${YADE_LIB_DIR} NO_DEFAULT_PATH REQUIRED)
find_library(YADE_COMMON_LIBRARY pkg_common PATHS ${YADE_LIB_DIR} NO_DEFAULT_PATH REQUIRED)
find_library(YADE_DEM_LIBRARY pkg_dem PATHS ${YADE_LIB_DIR} NO_DEFAULT_PATH REQUIRED)

add_library(Yade::Yade INTERFACE IMPORTED)
target_include_directories(Yade::Yade SYSTEM INTERFACE ${YADE_SOURCE_DIR} ${YADE_PYTHON_INCLUDE})
target_compile_definitions(Yade::Yade INTERFACE ${yade_definitions})
target_link_libraries(Yade::Yade INTERFACE
  ${YADE_DEM_LIBRARY} ${YADE_COMMON_LIBRARY} ${YADE_CORE_LIBRARY} ${YADE_PYTHON_LIBRARY} ${Boost_LIBRARIES} OpenMP::OpenMP_CXX)
target_include_directories(Yade::Yade SYSTEM INTERFACE ${Boost_INCLUDE_DIRS})

if("MPI" IN_LIST YADE_FEATURES)
  set(MPI_CXX_SKIP_MPICXX ON)
  find_package(MPI REQUIRED COMPONENTS CXX)
  target_include_directories(Yade::Yade SYSTEM INTERFACE ${MPI_CXX_INCLUDE_DIRS})
  target_compile_definitions(Yade::Yade INTERFACE OMPI_SKIP_MPICXX)
endif()
if("YADE_OPENGL" IN_LIST yade_definitions)
  find_package(OpenGL REQUIRED)
  target_link_libraries(Yade::Yade INTERFACE OpenGL::GL)
endif()

message(STATUS "YADE ${YADE_VERSION} in ${YADE_LIB_DIR}, headers of ${YADE_HEADER_VERSION}, Python ${YADE_PYTHON_VERSION}")
