# SPDX-License-Identifier: GPL-2.0-or-later
# Compile definitions that the host was built with, from the features it reports: they change class layouts.
# In: YADE_FEATURES YADE_REAL_BITS YADE_REAL_DIGITS.  Out: yade_definitions.

# feature -> definitions. CGAL is left out on purpose: it adds number traits to the headers, never a data member.
set(yade_feature_LOGGER YADE_BOOST_LOG BOOST_LOG_DYN_LINK)
set(yade_feature_COMPLEX_MP YADE_COMPLEX_MP)
set(yade_feature_OPENMP YADE_OPENMP)
set(yade_feature_VTK YADE_VTK)
set(yade_feature_QT5 YADE_OPENGL)
set(yade_feature_QT6 YADE_OPENGL)
set(yade_feature_MPI YADE_MPI)
set(yade_feature_LS_DEM YADE_LS_DEM)
set(yade_feature_FEMLIKE YADE_FEM)
set(yade_feature_SPH YADE_SPH)
set(yade_feature_DEFORM YADE_DEFORM)
set(yade_feature_LIQMIGRATION YADE_LIQMIGRATION)
set(yade_feature_PROFILING USE_TIMING_DELTAS ISC_TIMING)

if(NOT YADE_REAL_BITS EQUAL 64)
  message(FATAL_ERROR "This YADE computes with ${YADE_REAL_BITS}-bit numbers; yade-timber needs the 64-bit build (double).")
endif()
foreach(feature MASK_ARBITRARY VECTORIZE)
  if(feature IN_LIST YADE_FEATURES)
    message(FATAL_ERROR "This YADE was built with ${feature}, whose class layouts yade-timber does not know.")
  endif()
endforeach()

set(yade_definitions
    YADE_REAL_BIT=${YADE_REAL_BITS} YADE_REAL_DEC=${YADE_REAL_DIGITS} MAX_LOG_LEVEL=5
    YADE_ODEINT BOOST_BIND_GLOBAL_PLACEHOLDERS BOOST_ALLOW_DEPRECATED_HEADERS EIGEN_DONT_VECTORIZE EIGEN_DONT_ALIGN EIGEN_DISABLE_UNALIGNED_ARRAY_ASSERT)
foreach(feature IN LISTS YADE_FEATURES)
  list(APPEND yade_definitions ${yade_feature_${feature}})
endforeach()
list(REMOVE_DUPLICATES yade_definitions)
