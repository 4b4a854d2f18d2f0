# Completion of viewproj for bash: commands, topics after help, and the options that COMMAND --help lists. File names,
# and what else follows, are left to bash.
_viewproj() {
  local word=${COMP_WORDS[COMP_CWORD]} words=
  if [ "$COMP_CWORD" -eq 1 ]; then
    words="$("$1" --help | sed -n '/^Usage:/,/^Topics/s/^  \([a-z]*\) .*/\1/p') --help --version"
  elif [ "$COMP_CWORD" -eq 2 ] && [ "${COMP_WORDS[1]}" = help ] && [[ $word != -* ]]; then
    words=$("$1" --help | sed -n 's/^  \([a-z][a-z]*\) .*/\1/p')
  elif [[ $word == -* ]]; then
    # "  -c, --camera FILE   text": the names are in front of the first two blanks.
    words=$("$1" "${COMP_WORDS[1]}" --help 2>/dev/null | sed -n 's/^  \(-[^ ].*\)/\1/p' | sed 's/  .*//' |
      tr -s ', ' '\n' | grep '^-')
  fi
  # shellcheck disable=SC2207  # none of the words has a blank
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -o bashdefault -o default -F _viewproj viewproj
