#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# run_page.py fails where a block fails or prints something else, and counts what it cannot run.
#   run_page_test.sh RUN_PAGE PYTHON
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin"
run_page=$1 python=$2
page() {  # EXPECTED_STATUS EXPECTED_WORDS, the page on standard input
  cat > "$work/page.md"
  local status=0
  "$python" "$run_page" "$work/page.md" --bin "$work/bin" > "$work/said" 2>&1 || status=$?
  [[ "$status" == "$1" ]] || { echo "status $status, expected $1:"; cat "$work/said" "$work/page.md"; exit 1; }
  grep -qF -- "$2" "$work/said" || { echo "expected: $2"; cat "$work/said"; exit 1; }
}

page 0 "2 blocks ran" << 'END'
```sh
false, and not run
```
```python file=a/b.py
print("the left corner: 10.00 mm")
print("and more")
```
```sh run
python3 a/b.py
```
```text printed
the left corner:   10.01 mm
... more
```
```python run
assert True
```
END
page 1 "not printed (in this order): 12.5 mm" << 'END'
```sh run
echo 12.0 mm
```
```text printed
12.5 mm
```
END
page 1 "not printed (in this order): 11 mm" << 'END'
```sh run
echo 10 mm
```
```text printed within=10
10.9 mm
```
```text printed within=5
11 mm
```
END
page 1 "page.md:1: ended with 3" << 'END'
```sh run
exit 3
```
END
page 1 "not printed (in this order): a" << 'END'
```sh run
echo a; echo b
```
```text printed
b
a
```
END
page 77 "skipped, there is no no-such-program" << 'END'
```sh run
true
```
```sh run needs=no-such-program
no-such-program
```
```text printed
anything
```
END
page 1 "no block has written a.png" << 'END'
![a picture](../images/tutorials/a.png)
```sh run
true
```
END
page 1 "nothing to run" <<< 'words'
echo ok
