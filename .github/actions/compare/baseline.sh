#!/usr/bin/env bash
# Appends what changed between two reports to the summary of compare.sh. Reports may hold any text: in the summary it is a block of code.
#   PROGRAM, OLD, NEW   the program meshfolio, and two folders of reports or batches
#   SUMMARY, OUT        the Markdown file of compare.sh, and the folder that gets changes.html
#   GITHUB_OUTPUT       gets "changed", which replaces that of compare.sh: 0 if nothing changed in meshes and reports
#   CHANGED             the number of changed meshes
set -euo pipefail
most=30000   # bytes: a comment has at most 65,536 characters

code=0
timeout 600 "$PROGRAM" diff "$OLD" "$NEW" --html "$OUT/changes.html" > "$OUT/changes.txt" 2> "$OUT/changes.log" || code=$?
changed=$CHANGED
if [ "$code" = 1 ]; then changed=$((changed + 1)); fi
{
    printf '\n### What changed in the report\n\n'
    case $code in
        0 | 1)
            printf '`````text\n'
            head -c "$most" "$OUT/changes.txt" | tr '`' "'"
            if [ "$(wc -c < "$OUT/changes.txt")" -gt "$most" ]; then printf '\n…'; fi
            printf '\n`````\n' ;;
        *) printf 'The reports cannot be compared: `%s`\n' "$(tail -n 1 "$OUT/changes.log" | tr '`' "'")" ;;
    esac
} >> "$SUMMARY"
printf 'changed=%d\n' "$changed" >> "${GITHUB_OUTPUT:-/dev/null}"
