# Debian packages by cpack: umbrameter (program, man page, completion, presets, schema), libumbrameter-dev (headers, static
# libraries, CMake package) and python3-umbrameter. scripts/package builds them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME umbrameter)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The Umbrameter team <umbrameter@users.noreply.github.com>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # that of each package is the first line of its description
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program dev python)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

cmake_host_system_information(RESULT release QUERY DISTRIB_INFO)
set(CPACK_DEBIAN_PACKAGE_RELEASE "1~deb${release_VERSION_ID}")

# The Debian packages that hold these files.
function(packages_of result)
  set(packages)
  foreach(file IN LISTS ARGN)
    execute_process(COMMAND dpkg-query --search ${file} OUTPUT_VARIABLE found ERROR_QUIET)
    if(found MATCHES "^([a-z0-9.+-]+)[:,]")
      list(APPEND packages ${CMAKE_MATCH_1})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES packages)
  list(SORT packages)
  set(${result} ${packages} PARENT_SCOPE)
endfunction()

# What the program links is computed by dpkg-shlibdeps. It also opens the EGL driver, starts node to draw plots, and
# writes text in DejaVu Sans.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME umbrameter)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libegl1, libegl-mesa0, libgl1, libgl1-mesa-dri, nodejs (>= 18), fonts-dejavu-core")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "measures how wrong real-time shadows and ambient occlusion are
The same glTF scene goes through an OpenGL rasteriser (shadow maps, SSAO) and
through a ray tracer. Umbrameter turns the difference into error maps, causes
and statistics, and finds the bias and kernel parameters of least error.
It needs neither a display nor a GPU.")

# Who links the static libraries needs the packages that they were built with.
set(used ${glm_DIR} ${TBB_DIR} ${meshoptimizer_DIR} ${draco_DIR} ${embree_DIR} ${Imath_DIR} ${OpenEXR_DIR} ${PNG_LIBRARY}
         ${ZLIB_LIBRARY} ${fmt_DIR} ${nlohmann_json_DIR} ${tomlplusplus_DIR} ${SQLite3_LIBRARY} ${SQLiteCpp_DIR} ${CLI11_DIR}
         ${NLopt_DIR})
foreach(library epoxy xxhash deflate rsvg-2 nlopt_cxx EGL)
  find_library(UMBRAMETER_PACKAGED_${library} ${library})
  mark_as_advanced(UMBRAMETER_PACKAGED_${library})
  list(APPEND used ${UMBRAMETER_PACKAGED_${library}})
endforeach()
packages_of(dev_packages ${used})
list(JOIN dev_packages ", " dev_packages)
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libumbrameter-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "${dev_packages}")
set(CPACK_COMPONENT_DEV_DESCRIPTION "shadow and ambient-occlusion error measurement, C++ libraries
The rooms of umbrameter as static libraries, their headers, and a CMake
package: find_package(umbrameter) gives umbrameter::experiments and others.")

# The package python/ of the same version as the program that it starts.
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-umbrameter)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= 3.11), python3-numpy, umbrameter (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-pandas, python3-matplotlib")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "shadow and ambient-occlusion error measurement, Python package
Starts umbrameter with typed parameters and reads its results: tables with
units, images as arrays, plots, and an objective for optimisers.")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/python/umbrameter DESTINATION lib/python3/dist-packages COMPONENT python
        EXCLUDE_FROM_ALL PATTERN __pycache__ EXCLUDE)

# What Debian's policy wants in /usr/share/doc/PACKAGE.
set(documents ${PROJECT_BINARY_DIR}/package-documents)
file(MAKE_DIRECTORY ${documents})
set(copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: umbrameter

Files: *
Copyright: 2026 The Umbrameter team
License: Apache-2.0
 On Debian systems the text is in /usr/share/common-licenses/Apache-2.0.
")
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH when set
set(history "umbrameter (${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) stable; urgency=medium

  * Release ${PROJECT_VERSION}. Its changes are in CHANGELOG.md.

 -- ${CPACK_PACKAGE_CONTACT}  ${now}
")
file(CONFIGURE OUTPUT ${documents}/copyright CONTENT "@copyright@" @ONLY)
file(CONFIGURE OUTPUT ${documents}/changelog.Debian CONTENT "@history@" @ONLY)
execute_process(COMMAND gzip --best --no-name --force ${documents}/changelog.Debian)
install(FILES ${documents}/copyright ${documents}/changelog.Debian.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/umbrameter
        COMPONENT program EXCLUDE_FROM_ALL)
install(FILES ${documents}/copyright ${documents}/changelog.Debian.gz
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libumbrameter-dev COMPONENT dev EXCLUDE_FROM_ALL)
install(FILES ${documents}/copyright ${documents}/changelog.Debian.gz
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-umbrameter COMPONENT python EXCLUDE_FROM_ALL)
include(CPack)
