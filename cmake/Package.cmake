# SPDX-License-Identifier: GPL-2.0-or-later
# What is installed besides the module and the Python package, and the Debian package (scripts/package).

install(PROGRAMS scripts/yade-timber DESTINATION bin)
install(DIRECTORY scripts/ DESTINATION share/yade-timber/scripts USE_SOURCE_PERMISSIONS
  PATTERN __pycache__ EXCLUDE PATTERN setup EXCLUDE PATTERN package EXCLUDE PATTERN format EXCLUDE PATTERN build_docs EXCLUDE PATTERN yade-timber EXCLUDE PATTERN bench EXCLUDE PATTERN own_law EXCLUDE)

install(FILES LICENSE DESTINATION share/doc/yade-timber RENAME copyright)

execute_process(COMMAND dpkg-query -W -f=\${Version} yade OUTPUT_VARIABLE yade_package_version ERROR_QUIET)
execute_process(COMMAND dpkg --print-architecture OUTPUT_VARIABLE architecture OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME yade-timber)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The yade-timber developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Timber-frame houses under earthquakes and snow, for YADE")
set(CPACK_PACKAGE_DESCRIPTION "A plugin for the discrete-element framework YADE: rounded polyhedra, timber and snow contact laws, breakable joints, and scripts that build and run houses.")
set(CPACK_DEBIAN_FILE_NAME "yade-timber_${PROJECT_VERSION}_${architecture}.deb")
set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE ${architecture})
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# The module fits one build of YADE; its other libraries come with it.
set(CPACK_DEBIAN_PACKAGE_DEPENDS
  "yade (= ${yade_package_version}), python3-numpy, python3-scipy, python3-h5py, python3-jinja2, python3-matplotlib, python3-pil, python3-moderngl, libegl1, libgl1-mesa-dri, python3-yaml, python3-tqdm, libtbb12")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-vtk9, ffmpeg, fonts-ipafont-gothic") # yade-timber vtk and film, Japanese names
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/postinst ${PROJECT_SOURCE_DIR}/cmake/debian/prerm)
set(CPACK_SET_DESTDIR ON)
set(CPACK_INSTALL_PREFIX /usr)
include(CPack)
