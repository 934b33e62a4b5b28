# Writes OUTPUT, a header with the commit of SOURCE and whether the tracked files differ from it. Runs in every build;
# an unchanged header is left alone, so that nothing is compiled again.
set(hash "unknown")
set(dirty "false")
find_program(GIT_PROGRAM git)
if(GIT_PROGRAM)
  # Git refuses the checkout of another user (a build as root) unless told that it is meant.
  set(git ${GIT_PROGRAM} -c safe.directory=${SOURCE} -C ${SOURCE})
  execute_process(COMMAND ${git} rev-parse --show-toplevel OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE
                  ERROR_QUIET RESULT_VARIABLE failed)
  # A tarball unpacked inside somebody else's repository is not at that repository's commit.
  file(REAL_PATH "${SOURCE}" source)
  if(NOT failed AND top STREQUAL source)
    execute_process(COMMAND ${git} rev-parse --verify HEAD OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE
                    ERROR_QUIET RESULT_VARIABLE failed)
    if(NOT failed)
      set(hash "${head}")
      execute_process(COMMAND ${git} --no-optional-locks status --porcelain --untracked-files=no
                      OUTPUT_VARIABLE changes ERROR_QUIET)
      if(NOT changes STREQUAL "")
        set(dirty "true")
      endif()
    endif()
  endif()
endif()
set(text "#pragma once\n\nnamespace crumble::build {\ninline constexpr const char* git = \"${hash}\";\n")
string(APPEND text "inline constexpr bool dirty = ${dirty};\n}  // namespace crumble::build\n")
set(old "")
if(EXISTS "${OUTPUT}")
  file(READ "${OUTPUT}" old)
endif()
if(NOT text STREQUAL old)
  file(WRITE "${OUTPUT}" "${text}")
endif()
