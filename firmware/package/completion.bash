# bash completion of Pinhole's programs: commands, options, names of demos and boards, as the program itself lists them.
_pinhole() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} words
    [ "$before" != = ] || before=${COMP_WORDS[COMP_CWORD - 2]}
    case $before in
    --demo) words=$(pinhole-sim --list 2>/dev/null | awk '$1 == "demo" { print $2 }') ;;
    --board) words=$(pinhole-sim --list 2>/dev/null | awk '$1 == "board" { print $2 }') ;;
    *) words=$("$1" --help 2>/dev/null | awk '/^  --/ { print $1 } /^  [a-z]+  / && !/^  --/ { print $1 }') ;;
    esac
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word"; [[ $before == --demo || $before == --board || $word == -* ]] || compgen -f -- "$word")
}
complete -o filenames -F _pinhole pinhole-asset pinhole-depth pinhole-emulate pinhole-flash pinhole-panel pinhole-sheet pinhole-sim pinhole-wire
