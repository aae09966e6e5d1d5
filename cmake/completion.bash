# Completion for bash, and for zsh after bashcompinit: verbs and options as --help lists them, otherwise files.
_mckibben() {
  local word=${COMP_WORDS[COMP_CWORD]} words=
  if [ "$COMP_CWORD" = 1 ]; then
    words=$("$1" --help 2> /dev/null | grep -oE '^  [a-z]+  ')
  elif [ "${word#-}" != "$word" ]; then
    words=$("$1" "${COMP_WORDS[1]}" --help 2> /dev/null | grep -oE '^ +(-[a-z],)?--[a-z-]+' | grep -oE '[-][-].*')
  fi
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -o default -F _mckibben mckibben
