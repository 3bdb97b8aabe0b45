# SPDX-License-Identifier: GPL-2.0-or-later
# The module _yade_timber: every class in pkg/*.cpp, linked without undefined symbols against the installed YADE.

string(REPLACE ";" " " build_features "${YADE_FEATURES}")
configure_file(${PROJECT_SOURCE_DIR}/pkg/build_info.hpp.in ${PROJECT_BINARY_DIR}/generated/build_info.hpp)

file(GLOB plugin_sources CONFIGURE_DEPENDS pkg/*.cpp)
add_library(_yade_timber MODULE ${plugin_sources})
target_include_directories(_yade_timber PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/generated)
target_link_libraries(_yade_timber PRIVATE timber_kernel Yade::Yade)
target_link_options(_yade_timber PRIVATE -Wl,-z,defs -Wl,--as-needed)
target_precompile_headers(_yade_timber PRIVATE pkg/pch.hpp)
set(package_dir ${PROJECT_BINARY_DIR}/python/yade_timber)
set_target_properties(_yade_timber PROPERTIES
  PREFIX "" INSTALL_RPATH ${YADE_LIB_DIR} BUILD_RPATH ${YADE_LIB_DIR} LIBRARY_OUTPUT_DIRECTORY ${package_dir})
# YADE's macros leave unused parameters and ignored qualifiers in the including file.
target_compile_options(_yade_timber PRIVATE -Wno-unused-parameter)

# The uninstalled package: links to the sources beside the built module, so that tests see both as they are now.
file(GLOB package_entries CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/py/yade_timber/*)
file(MAKE_DIRECTORY ${package_dir})
foreach(entry IN LISTS package_entries)
  get_filename_component(name ${entry} NAME)
  file(CREATE_LINK ${entry} ${package_dir}/${name} SYMBOLIC)
endforeach()

set(TIMBER_SITE_DIR ${YADE_SITE_DIR} CACHE PATH "Python folder that the package is installed into")
install(TARGETS _yade_timber LIBRARY DESTINATION ${TIMBER_SITE_DIR}/yade_timber)
install(DIRECTORY py/yade_timber DESTINATION ${TIMBER_SITE_DIR} PATTERN __pycache__ EXCLUDE)
