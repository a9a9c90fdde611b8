# Installs the build into an empty prefix, then configures, builds and runs the consumer project against that prefix.
file(REMOVE_RECURSE ${work})
set(prefix ${work}/prefix)

set(flags)
if(sanitize)
  set(flags -DCMAKE_CXX_FLAGS=-fsanitize=${sanitize})
endif()

execute_process(COMMAND ${CMAKE_COMMAND} --install ${build} --prefix ${prefix} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -S ${source} -B ${work}/build -G ${generator} -DCMAKE_PREFIX_PATH=${prefix}
                        -DCMAKE_CXX_COMPILER=${compiler} -DCMAKE_C_COMPILER=${c_compiler} ${flags}
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${work}/build COMMAND_ERROR_IS_FATAL ANY)
# Its exit code 3: no OpenGL driver, a skip.
execute_process(COMMAND ${work}/build/consumer RESULT_VARIABLE result)
if(result EQUAL 3)
  message("no OpenGL driver")
elseif(NOT result EQUAL 0)
  message(FATAL_ERROR "the consumer ended with ${result}")
endif()
execute_process(COMMAND ${prefix}/bin/umbrameter --version COMMAND_ERROR_IS_FATAL ANY)
foreach(file share/bash-completion/completions/umbrameter share/zsh/site-functions/_umbrameter
             share/fish/vendor_completions.d/umbrameter.fish share/man/man1/umbrameter.1.gz)
  if(NOT EXISTS ${prefix}/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
