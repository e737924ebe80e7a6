# SPDX-License-Identifier: GPL-3.0-or-later
# Completion for bash: subcommands, options and files of hyperex, as its help texts list them.
_hyperex() {
  local word=${COMP_WORDS[COMP_CWORD]} command=
  COMPREPLY=()
  ((COMP_CWORD > 1)) && command=${COMP_WORDS[1]}
  if [[ $COMP_CWORD == 1 && $word != -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(hyperex --help 2> /dev/null |
      sed -n '/^Subcommands:/,$s/^  \([a-z-]\{1,\}\).*/\1/p')" -- "$word")
  elif [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(hyperex $command --help 2> /dev/null |
      grep -o -- '--[a-z][a-z-]*' | sort -u)" -- "$word")
  fi
}
# Where nothing else fits, names of files.
complete -o default -o bashdefault -F _hyperex hyperex
