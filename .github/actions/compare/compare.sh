#!/usr/bin/env bash
# Compares the meshes that differ between two commits of the repository in the current folder. A pull request may bring any name of a file or
# mesh: names are only data, and only their plain letters are printed.
#   PROGRAM, BASE, HEAD, OUT   the program meshfolio, two commits, a folder to write to
#   BRANCH, REPOSITORY_URL     the branch and repository that keep the sheets; without BRANCH, sheets are not pushed
#   GITHUB_OUTPUT              gets "summary", the written file, and "changed", the number of changed meshes
set -euo pipefail
most=30   # drawn meshes: a comment has at most 65,536 characters
rm -rf "$OUT"
mkdir -p "$OUT/meshes"
summary=$OUT/summary.md

for commit in "$BASE" "$HEAD"; do
    git cat-file -e "$commit^{commit}" 2>/dev/null || git fetch --quiet --depth=1 origin "$commit"
done
before=$(git merge-base "$BASE" "$HEAD" 2>/dev/null || echo "$BASE")   # without history: all differences

plain() { printf %s "$1" | LC_ALL=C tr -c 'A-Za-z0-9._:/ -' '?'; }

rows=() sheets=() count=0
# row NAME CELLS…
row() {
    local line cell
    line="| \`$(plain "$1")\` |"
    for cell in "${@:2}"; do line+=" $cell |"; done
    rows+=("$line")
}
# failed NAME FOLDER: adds a row with the last line of the program
failed() {
    local said
    said=$(tail -n 1 "$2/log")
    row "$1" "\`$(plain "${said//"$2/"/}")\`" – – – – –
}

# draw NAME FOLDER MESH…: draws one mesh, or two as a pair
draw() {
    local name=$1 folder=$2
    if [ $# = 4 ]; then
        timeout 600 "$PROGRAM" render "$3" "$4" --field distance --fit common --views +x,-x,+y,-y,+z,-z --columns 4 --dpi 200 \
            -o "$folder/sheet.png" >> "$folder/log" 2>&1 || return
    else
        timeout 600 "$PROGRAM" render "$3" --size 320 --views +x,+y,+z,hero --out "$folder" >> "$folder/log" 2>&1 || return
    fi
    sheets+=("$folder/sheet.png" "$(plain "$name")")
}

# taken COMMIT PATH FILE: writes the file as a checkout would, with large files of LFS
taken() { git cat-file --filters "$1:$2" > "$3"; }

compared() {   # STATUS OLD NEW
    local status=$1 old=$2 new=$3 folder name was=
    count=$((count + 1))
    if [ "$count" -gt "$most" ]; then return; fi
    folder=$OUT/meshes/$count name=$(plain "${new##*/}")
    name=${name: -$((${#name} < 200 ? ${#name} : 200))}
    if [ "$old" != "$new" ]; then was=", was \`$(plain "$old")\`"; fi
    mkdir -p "$folder"
    case $status in
        D) row "$new" removed – – – – –; return ;;
        T) row "$new" 'a file or a link, which it was not' – – – – –; return ;;
        A)
            taken "$HEAD" "$new" "$folder/$name"
            if draw "$new" "$folder" "$folder/$name"; then row "$new" new – – – – –; else failed "$new" "$folder"; fi
            return ;;
    esac
    if [ "$(git rev-parse "$before:$old")" = "$(git rev-parse "$HEAD:$new")" ]; then
        row "$new" "$([ -n "$was" ] && echo "moved$was" || echo 'other permissions')" – – – – –
        return
    fi
    taken "$before" "$old" "$folder/before $name"
    taken "$HEAD" "$new" "$folder/after $name"
    if ! timeout 600 "$PROGRAM" compare "$folder/before $name" "$folder/after $name" --html "$folder/page.html" \
            > "$folder/numbers.txt" 2> "$folder/log"; then
        failed "$new" "$folder"
        return
    fi
    number() { awk -v key="$1" '$1 == key { print $2 }' "$folder/numbers.txt"; }
    row "$new" "changed$was" "$(number rms)" "$(number hausdorff)" "$(number mean_normal_angle_deg)" "$(number volume_ratio)" "$(number area_ratio)"
    draw "$new" "$folder" "$folder/before $name" "$folder/after $name" || true   # the row has the numbers
}

while IFS= read -r -d '' status && IFS= read -r -d '' old; do
    new=$old
    if [[ $status == R* ]]; then IFS= read -r -d '' new; fi
    if [ "${old##*.}" != "${new##*.}" ]; then status=A; fi   # another format: shows only the new mesh
    compared "${status:0:1}" "$old" "$new"
done < <(git diff -z --name-status --find-renames --diff-filter=AMDRT "$before" "$HEAD" -- ':(icase)*.obj' ':(icase)*.off' ':(icase)*.ply' ':(icase)*.stl' \
    ':(icase)*.glb' ':(icase)*.vtp' ':(icase)*.obj.gz' ':(icase)*.off.gz' ':(icase)*.ply.gz' ':(icase)*.stl.gz' \
    ':(icase)*.glb.gz' ':(icase)*.vtp.gz')

# Pushes the sheets, one commit for each run, and prints their address.
kept_sheets() {
    local parent tree commit i
    export GIT_INDEX_FILE=$OUT/index
    parent=$(git ls-remote origin "refs/heads/$BRANCH" | cut -f 1)
    if [ -n "$parent" ]; then git fetch --quiet --depth=1 origin "$parent" && git read-tree "$parent"; fi
    for ((i = 0; i < ${#sheets[@]}; i += 2)); do
        git update-index --add --cacheinfo "100644,$(git hash-object -w "${sheets[i]}"),$HEAD/$((i / 2)).png"
    done
    tree=$(git write-tree)
    commit=$(GIT_AUTHOR_NAME=meshfolio GIT_AUTHOR_EMAIL=meshfolio@users.noreply.github.com GIT_COMMITTER_NAME=meshfolio \
        GIT_COMMITTER_EMAIL=meshfolio@users.noreply.github.com git commit-tree "$tree" ${parent:+-p "$parent"} -m "Meshes of $HEAD")
    git push --quiet origin "$commit:refs/heads/$BRANCH"
    echo "$REPOSITORY_URL/blob/$commit/$HEAD"
}

{
    printf '<!-- meshfolio compare -->\n### Meshes that change\n\n'
    if [ "$count" = 0 ]; then
        echo 'None.'
    else
        printf '| mesh | | rms | Hausdorff | normals [°] | volume ratio | area ratio |\n|---|---|--:|--:|--:|--:|--:|\n'
        printf '%s\n' "${rows[@]}"
        printf '\nLengths are in the unit of the files, Hausdorff distances at most 0.1 %% too small; ratios are after over before.\n'
        if [ "$count" -gt "$most" ]; then printf '\n%d more are not shown.\n' $((count - most)); fi
    fi
    if [ -n "${BRANCH:-}" ] && [ ${#sheets[@]} -gt 0 ]; then
        url=$(kept_sheets)
        for ((i = 0; i < ${#sheets[@]}; i += 2)); do
            printf '\n<details><summary><code>%s</code></summary>\n\n![before, and after beside it](%s/%d.png?raw=true)\n</details>\n' \
                "${sheets[i + 1]}" "$url" $((i / 2))
        done
    fi
} > "$summary"
printf 'summary=%s\nchanged=%d\n' "$summary" "$count" >> "${GITHUB_OUTPUT:-/dev/null}"
