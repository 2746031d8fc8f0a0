# `./dev package`: pbrt and pbrt-dev for Debian, and one archive with both in it.

set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_NAME pbrt)
set(CPACK_PACKAGE_CONTACT "pbrt maintainers <maintainers@pbrt.invalid>")
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 0)
set(CPACK_COMPONENTS_ALL runtime devel)
set(CPACK_DEB_COMPONENT_INSTALL ON)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME pbrt)
set(CPACK_DEBIAN_DEVEL_PACKAGE_NAME pbrt-dev)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
    "Reads the scenes of pbrt-v1 to v4, opens the plug-ins that a scene names, writes OpenEXR.
Traces metaballs without a mesh.")
set(CPACK_COMPONENT_DEVEL_DESCRIPTION
    "Headers and CMake package: what shapes, integrators and other plug-ins are built with.")
# What the programs link to is found by dpkg-shlibdeps; plug-ins link to the library of the package.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_DEVEL_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVEL_PACKAGE_DEPENDS
    "pbrt (= ${PROJECT_VERSION}), libglm-dev, libfmt-dev, g++ | c++-compiler, cmake, make | ninja-build")
include(CPack)
