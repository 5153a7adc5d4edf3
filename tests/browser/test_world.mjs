// World for the tests: 12 x 12 m, with gold 3 m ahead of Ann and 1 m to her left, and Bob behind her.

import { rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

export const GOLD = { x: 3, y: 1, z: 0.25 };

// @param ann, bob robot types
export function writeTestWorld(ann = 'pioneer3dx', bob = 'scout') {
  const file = join(tmpdir(), `robosim_world_${process.pid}.xml`);
  process.once('exit', () => rmSync(file, { force: true }));
  writeFileSync(file, `<world><surface>
    <size><xmin>-6</xmin><xmax>6</xmax><ymin>-6</ymin><ymax>6</ymax></size>
    <object><shape><primitive><cylinder><name>Gold</name><x>${GOLD.x}</x><y>${GOLD.y}</y><z>${GOLD.z}</z>
      <radius>0.2</radius><height>0.5</height><color>1 0.8 0.1</color><hot>20</hot></cylinder></primitive></shape></object>
    <object><shape><robot><model>${ann}</model><name>Ann</name><x>0</x><y>0</y></robot></shape></object>
    <object><shape><robot><model>${bob}</model><name>Bob</name><x>-3</x><y>0</y></robot></shape></object>
  </surface></world>`);
  return file;
}
