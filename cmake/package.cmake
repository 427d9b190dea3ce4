# The Debian package of the programs (make deb). What they need at run time is found by dpkg-shlibdeps.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME veritrack)
set(CPACK_PACKAGE_CONTACT "The Veritrack authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "certificates for frequency trackers, and a checker for them")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_BINARY_DIR}/packages")
set(CPACK_STRIP_FILES ON)
# The library is for `cmake --install`: static, and with an interface that still changes.
set(CPACK_COMPONENTS_ALL programs)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME veritrack)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION math)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Figures of certificates. Without it there are none.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS gnuplot-nox)
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION
    "Veritrack proves what a frequency tracker of a given design does: bounds on its error, and which noise and\n slew it tolerates, with outward-rounded interval arithmetic. veritrack-verify checks its certificates again.")
include(CPack)
