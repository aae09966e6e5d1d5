# What the program says of itself, for the system: a manual page of each verb, which is its --help.
#   cmake -D PROGRAM=mckibben -D FOLDER=said -D VERSION=0.1.0 -P said.cmake
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER}/man1)

# page(NAME ARGUMENTS...): of the program, or of one of its verbs.
function(page name)
  execute_process(COMMAND ${PROGRAM} ${ARGN} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "^[^\n:;]*" sentence "${help}")
  string(REGEX REPLACE "\\\\" "\\\\(rs" text "${help}")
  string(REGEX REPLACE "(^|\n)([.'])" "\\1\\\\&\\2" text "${text}")
  string(REPLACE "-" "\\-" text "${text}")
  file(WRITE ${FOLDER}/man1/${name}.1 ".TH ${name} 1 \"\" \"McKibben ${VERSION}\"\n.SH NAME\n${name} \\- ${sentence}\n"
       ".SH DESCRIPTION\n.nf\n${text}.fi\n")
  set(help "${help}" PARENT_SCOPE)
endfunction()
page(mckibben)
string(REGEX MATCHALL "\n  [a-z]+  " verbs "${help}")
foreach(verb ${verbs})
  string(STRIP "${verb}" verb)
  page(mckibben-${verb} ${verb})
endforeach()
