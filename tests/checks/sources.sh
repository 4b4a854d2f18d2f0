# shellcheck shell=sh
# Sourced by the checks. sources PATTERN...: the project's files, as Git knows them; without Git, all.
sources() {
  git ls-files --cached --others --exclude-standard "$@" 2>/dev/null | while IFS= read -r file; do
    if [ -f "$file" ]; then echo "$file"; fi
  done | grep . || {
    for pattern; do find .ci cmd lib samples tests -name node_modules -prune -o \( -path "*/$pattern" -o -name "$pattern" \) -print; done
  }
}
# None is passed over for want of a list.
for pattern in 'lib/*.cpp' 'cmd/*.cpp' 'tests/*.cpp' '*.sh'; do
  count=$(sources "$pattern" | wc -l)
  [ "$count" -ge 20 ] || { echo "only $count files $pattern" >&2; exit 1; }
done
