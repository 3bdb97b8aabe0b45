# SPDX-License-Identifier: GPL-2.0-or-later
# What is installed besides the module and the Python packages, and two Debian packages (scripts/package): the plugin yade-timber, and the
# application timber-houses.

install(PROGRAMS scripts/yade-timber DESTINATION bin COMPONENT houses)
install(DIRECTORY scripts/ DESTINATION share/yade-timber/scripts COMPONENT houses USE_SOURCE_PERMISSIONS
  PATTERN __pycache__ EXCLUDE PATTERN setup EXCLUDE PATTERN package EXCLUDE PATTERN format EXCLUDE PATTERN build_docs EXCLUDE PATTERN yade-timber EXCLUDE PATTERN bench EXCLUDE PATTERN own_law EXCLUDE)

install(FILES LICENSE DESTINATION share/doc/yade-timber COMPONENT plugin RENAME copyright)
install(FILES LICENSE DESTINATION share/doc/timber-houses COMPONENT houses RENAME copyright)

execute_process(COMMAND dpkg-query -W -f=\${Version} yade OUTPUT_VARIABLE yade_package_version ERROR_QUIET)
execute_process(COMMAND dpkg --print-architecture OUTPUT_VARIABLE architecture OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL plugin houses)
set(CPACK_PACKAGE_NAME yade-timber)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The yade-timber developers")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/postinst ${PROJECT_SOURCE_DIR}/cmake/debian/prerm)

set(CPACK_DEBIAN_PLUGIN_PACKAGE_NAME yade-timber)
set(CPACK_DEBIAN_PLUGIN_FILE_NAME "yade-timber_${PROJECT_VERSION}_${architecture}.deb")
set(CPACK_DEBIAN_PLUGIN_PACKAGE_ARCHITECTURE ${architecture})
set(CPACK_COMPONENT_PLUGIN_DESCRIPTION
  "Rounded polyhedra, timber and snow contact laws and breakable joints, for YADE\nA plugin for scenes of the discrete-element framework YADE.")
# The module fits one build of YADE; its other libraries come with it.
set(CPACK_DEBIAN_PLUGIN_PACKAGE_DEPENDS "yade (= ${yade_package_version}), python3-numpy, libtbb12")
set(CPACK_DEBIAN_PLUGIN_PACKAGE_CONTROL_EXTRA ${CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA})

set(CPACK_DEBIAN_HOUSES_PACKAGE_NAME timber-houses)
set(CPACK_DEBIAN_HOUSES_FILE_NAME "timber-houses_${PROJECT_VERSION}_all.deb")
set(CPACK_DEBIAN_HOUSES_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_HOUSES_DESCRIPTION
  "Timber-frame houses under earthquakes and snow, in YADE\nHouse files, ground motions, runs and pictures, with the command yade-timber.")
set(CPACK_DEBIAN_HOUSES_PACKAGE_DEPENDS
  "yade-timber (= ${PROJECT_VERSION}), python3-numpy, python3-scipy, python3-h5py, python3-jinja2, python3-matplotlib, python3-pil, python3-moderngl, libegl1, libgl1-mesa-dri, python3-yaml, python3-lxml, python3-tqdm")
set(CPACK_DEBIAN_HOUSES_PACKAGE_RECOMMENDS "python3-vtk9, ffmpeg, fonts-ipafont-gothic") # yade-timber vtk and film, Japanese names
set(CPACK_DEBIAN_HOUSES_PACKAGE_CONTROL_EXTRA ${CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA})

set(CPACK_SET_DESTDIR ON)
set(CPACK_INSTALL_PREFIX /usr)
include(CPack)
