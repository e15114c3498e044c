# Writes OUTPUT, a source with the text of `sikku --version`, at each build; left alone if nothing changed. The commit is
# COMMIT if it is given, that of the checkout in SOURCE, or that of an archive made by `git archive`.
# usage: cmake -D SOURCE=… -D OUTPUT=… -D VERSION=… [-D COMMIT=…] -P commit.cmake
if(NOT COMMIT AND EXISTS ${SOURCE}/.git)
    find_program(git git)
    if(git)
        execute_process(COMMAND ${git} -C ${SOURCE} rev-parse --short=12 HEAD
                        OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
        execute_process(COMMAND ${git} -C ${SOURCE} status --porcelain --untracked-files=no
                        OUTPUT_VARIABLE changes ERROR_QUIET)
        if(COMMIT AND changes)
            string(APPEND COMMIT ", with changes")
        endif()
    endif()
elseif(NOT COMMIT)
    file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/commit.txt COMMIT REGEX "^[0-9a-f]+$")
    string(SUBSTRING "${COMMIT}" 0 12 COMMIT)
endif()
set(text "sikku ${VERSION}")
if(COMMIT)
    string(APPEND text " (${COMMIT})")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#include \"cli/version.h\"\nconst char* sikku::version_text() { return \"${text}\"; }\n" @ONLY)
