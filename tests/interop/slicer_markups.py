# SPDX-License-Identifier: GPL-3.0-or-later
# Whether a file is what 3D Slicer's module Markups loads: python3 slicer_markups.py FILE.mrk.json
# The names are those of its schema, Modules/Loadable/Markups/Resources/Schema of Slicer 5.
import json
import sys

with open(sys.argv[1]) as file:
    root = json.load(file)
assert root['@schema'].startswith('https://raw.githubusercontent.com/slicer/slicer/'), root['@schema']
assert len(root['markups']) >= 1
count = 0
for markup in root['markups']:
    assert markup['type'] == 'Fiducial', markup['type']
    assert markup.get('coordinateSystem', 'LPS') in ('LPS', 'RAS')
    assert markup.get('coordinateUnits', 'mm') == 'mm'
    labels = [point['label'] for point in markup['controlPoints']]
    assert len(set(labels)) == len(labels)
    for point in markup['controlPoints']:
        assert len(point['position']) == 3 and all(isinstance(x, float) for x in point['position'])
        assert max(abs(x) for x in point['position']) < 2000, 'millimetres'
        assert point.get('positionStatus', 'defined') in ('defined', 'preview', 'missing', 'undefined')
    count += len(labels)
print(f'slicer: by the markups schema of Slicer 5, {count} control points in {sys.argv[1]}')
