# The program, the libraries, their headers, and a package that find_package(umbrameter) finds.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(UMBRAMETER_MODULES core scenes techniques raster raytrace compare reports settings results store present experiments)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/umbrameter)

foreach(module IN LISTS UMBRAMETER_MODULES)
  set_target_properties(umbrameter_${module} PROPERTIES EXPORT_NAME ${module})
  install(TARGETS umbrameter_${module} EXPORT umbrameter ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${module} OPTIONAL DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/umbrameter
          COMPONENT dev FILES_MATCHING PATTERN "*.h" PATTERN "techniques/shading/*.glsl" PATTERN "techniques/shadow/*.glsl" PATTERN "techniques/ao/*.glsl" PATTERN "shaders" EXCLUDE
          PATTERN "templates" EXCLUDE PATTERN "assets" EXCLUDE PATTERN "gl/api.h" EXCLUDE PATTERN "embree*" EXCLUDE
          PATTERN "gltf_*" EXCLUDE PATTERN "results_schema.h" EXCLUDE)
endforeach()
install(TARGETS umbrameter RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)

# Where bash-completion, zsh, fish and man look for them.
install(FILES ${UMBRAMETER_GENERATED}/umbrameter.bash RENAME umbrameter
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(FILES ${UMBRAMETER_GENERATED}/umbrameter.zsh RENAME _umbrameter
        DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT program)
install(FILES ${UMBRAMETER_GENERATED}/umbrameter.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
        COMPONENT program)
install(FILES ${UMBRAMETER_GENERATED}/umbrameter.man.gz RENAME umbrameter.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
        COMPONENT program)

# Dependencies.cmake goes along: the libraries are static, so who links them needs the same packages.
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/umbrameter-config.cmake.in
                              ${PROJECT_BINARY_DIR}/umbrameter-config.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/umbrameter-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/umbrameter-config.cmake ${PROJECT_BINARY_DIR}/umbrameter-config-version.cmake
              ${CMAKE_CURRENT_LIST_DIR}/Dependencies.cmake DESTINATION ${package_folder} COMPONENT dev)
install(EXPORT umbrameter NAMESPACE umbrameter:: FILE umbrameter-targets.cmake DESTINATION ${package_folder}
        COMPONENT dev)
install(FILES ${PROJECT_SOURCE_DIR}/docs/summary.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/umbrameter
        COMPONENT program)
# Adapters of engines; their packages come with each one's setup.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/engines DESTINATION ${CMAKE_INSTALL_DATADIR}/umbrameter COMPONENT program
        USE_SOURCE_PERMISSIONS PATTERN node_modules EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/presets DESTINATION ${CMAKE_INSTALL_DATADIR}/umbrameter COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)
