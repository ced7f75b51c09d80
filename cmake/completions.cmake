# SPDX-License-Identifier: MIT
# Completion scripts that rigc makes about itself, installed where the shells look for them.
foreach(shell bash zsh fish)
  list(APPEND rigc_completions COMMAND rigc completions ${shell} > ${CMAKE_BINARY_DIR}/completions.${shell})
endforeach()
add_custom_command(TARGET rigc POST_BUILD ${rigc_completions} VERBATIM)
install(FILES ${CMAKE_BINARY_DIR}/completions.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME rigc)
install(FILES ${CMAKE_BINARY_DIR}/completions.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions RENAME _rigc)
install(FILES ${CMAKE_BINARY_DIR}/completions.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d RENAME rigc.fish)
