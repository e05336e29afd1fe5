#!/bin/sh
# Tests tests/setup.sh with a fake apt that has every package except "nowhere". "here" is already installed.
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for name in apt-get apt-cache dpkg-query id; do
    cat >"$work/$name" <<'END'
#!/bin/sh
case "${0##*/} $*" in
    "id -u") echo 0 ;;
    "dpkg-query "*" here") echo installed ;;
    "dpkg-query "*) echo not-installed ;;
    *" nowhere"*) echo "E: Unable to locate package" >&2; exit 100 ;;
    "apt-get install "*) echo "$*" >>"$calls" ;;
esac
END
    chmod +x "$work/$name"
done

# asked OPTIONAL NAMES…: prints the exit code, the packages of each apt call, and the last message
asked() {
    : >"$work/calls"
    code=0
    (
        . "$root/tests/setup.sh"
        optional_packages=$1 calls=$work/calls PATH="$work:$PATH"
        shift
        export calls PATH
        install_packages "$@"
    ) 2>"$work/said" || code=$?
    echo "$code [$(sed 's/.*recommends //' "$work/calls" | paste -sd '|')] $(tail -n 1 "$work/said" | grep -v '^installing')"
}

expect() {
    [ "$2" = "$1" ] || { echo "expected: $1"; echo "found:    $2"; exit 1; }
}

expect "0 [] " "$(asked "" here)"
expect "0 [a b] " "$(asked "" a here b)"
expect "0 [a b c d] " "$(asked "c d" c a d b)"
expect "0 [a|c] continuing without these packages, which apt could not install: nowhere" "$(asked "nowhere c" a nowhere c)"
expect "0 [] continuing without these packages, which apt could not install: nowhere" "$(asked "nowhere" here nowhere)"
expect "5 []     a nowhere" "$(asked "" a nowhere)"
