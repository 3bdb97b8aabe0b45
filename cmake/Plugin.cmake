# SPDX-License-Identifier: GPL-2.0-or-later
# The module _yade_timber: every class in pkg/*.cpp, linked without undefined symbols against the installed YADE.

string(REPLACE ";" " " build_features "${YADE_FEATURES}")
configure_file(${PROJECT_SOURCE_DIR}/pkg/build_info.hpp.in ${PROJECT_BINARY_DIR}/generated/build_info.hpp)

file(GLOB plugin_sources CONFIGURE_DEPENDS pkg/*.cpp)
list(LENGTH plugin_sources plugin_count)
math(EXPR plugin_batch "(${plugin_count} + 1) / 2")
set(package_dir ${PROJECT_BINARY_DIR}/python/yade_timber)
set(TIMBER_SITE_DIR ${YADE_SITE_DIR} CACHE PATH "Python folder that both packages are installed into")

# A module over a kernel, in a folder of the Python package.
function(timber_module name kernel folder)
  add_library(${name} MODULE ${plugin_sources})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/generated)
  target_link_libraries(${name} PRIVATE ${kernel} Yade::Yade)
  target_link_options(${name} PRIVATE -Wl,-z,defs -Wl,--as-needed)
  target_precompile_headers(${name} PRIVATE <pch.hpp>)
  set_target_properties(${name} PROPERTIES
    UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${plugin_batch} # two units: in each one the headers of YADE instantiate half a minute of templates
    PREFIX "" OUTPUT_NAME _yade_timber INSTALL_RPATH ${YADE_LIB_DIR} BUILD_RPATH ${YADE_LIB_DIR} LIBRARY_OUTPUT_DIRECTORY ${package_dir}/${folder})
  # YADE's macros leave unused parameters and ignored qualifiers in the including file.
  target_compile_options(${name} PRIVATE -Wno-unused-parameter)
  install(TARGETS ${name} LIBRARY DESTINATION ${TIMBER_SITE_DIR}/yade_timber/${folder} COMPONENT plugin)
endfunction()

timber_module(_yade_timber timber_kernel "")
if(TIMBER_SECOND_MODULE AND TIMBER_KNOWS_X86_64_V3) # host.py imports it where the processor permits
  timber_kernel_library(timber_kernel_v3)
  timber_use_x86_64_v3(timber_kernel_v3)
  timber_module(_yade_timber_v3 timber_kernel_v3 x86_64_v3)
endif()

# The uninstalled packages: links to the sources, those of the plugin beside the built module, so that tests see both as they are now.
file(GLOB package_entries CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/py/yade_timber/*)
list(FILTER package_entries EXCLUDE REGEX __pycache__)
file(MAKE_DIRECTORY ${package_dir})
foreach(entry IN LISTS package_entries)
  get_filename_component(name ${entry} NAME)
  file(CREATE_LINK ${entry} ${package_dir}/${name} SYMBOLIC)
endforeach()
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/py/timber_houses ${PROJECT_BINARY_DIR}/python/timber_houses SYMBOLIC)

install(DIRECTORY py/yade_timber DESTINATION ${TIMBER_SITE_DIR} COMPONENT plugin PATTERN __pycache__ EXCLUDE)
install(DIRECTORY py/timber_houses DESTINATION ${TIMBER_SITE_DIR} COMPONENT houses PATTERN __pycache__ EXCLUDE)
