// What stands still in a plan: floor, maps and objects. Drawn with a canvas context, or one that writes SVG.

import { color } from './canvas.js';
import { multiplesIn, roundUpTo } from './plan_view.js';

const GRID_PX = 64;
const RASTER_SIDE = 4096;  // of a map that is drawn as a picture

// Rectangles of cells from the differences in which they are stored: calls visit(column, row, columns, rows).
export function forEachCells(list, visit) {
  for (let i = 0, column = 0, row = 0; i < list.length; i += 4) {
    column += list[i];
    row += list[i + 1];
    visit(column, row, list[i + 2], list[i + 3]);
  }
}

const rasters = new Map();

// The map's cells as a picture of a pixel for each, kept for later frames.
function rasterOf(map, fill) {
  const key = `${fill} ${color('surface')}`;
  const known = rasters.get(map);
  if (known?.key === key) return known.canvas;
  const canvas = document.createElement('canvas');
  canvas.width = map.columns;
  canvas.height = map.rows;
  const g = canvas.getContext('2d');
  const paint = (cells) => forEachCells(cells, (column, row, columns, rows) => g.fillRect(column, map.rows - row - rows, columns, rows));
  g.fillStyle = color('grid');
  paint(map.unknown);
  g.fillStyle = fill;
  paint(map.occupied);
  rasters.set(map, { key, canvas });
  return canvas;
}

function turned(g, [x, y, heading], draw) {
  g.save();
  g.translate(x, y);
  g.rotate(heading);
  draw();
  g.restore();
}

function drawMap(g, map, isSvg) {
  const fill = map.height > 0 ? color('wall') : map.color;
  turned(g, map.at, () => {
    if (map.columns) {
      turned(g, map.grid, () => {
        if (!isSvg && map.columns <= RASTER_SIDE && map.rows <= RASTER_SIDE) {
          g.imageSmoothingEnabled = false;
          g.scale(1, -1);
          g.drawImage(rasterOf(map, fill), 0, -map.rows * map.cell, map.columns * map.cell, map.rows * map.cell);
          return;
        }
        for (const [cells, ink] of [[map.unknown, color('grid')], [map.occupied, fill]]) {
          g.fillStyle = ink;
          g.beginPath();
          forEachCells(cells, (column, row, columns, rows) => g.rect(column * map.cell, row * map.cell, columns * map.cell, rows * map.cell));
          g.fill();
        }
      });
    }
    g.fillStyle = fill;
    for (const [x, y, heading, length, width] of map.boxes) {
      turned(g, [x, y, heading], () => {
        g.beginPath();
        g.rect(-length / 2, -width / 2, length, width);
        g.fill();
      });
    }
  });
}

// `at`: its present place
export function drawObject(g, object, at, pixel) {
  turned(g, at, () => {
    const outline = (more = 0) => {
      g.beginPath();
      if (object.size) g.rect(-object.size[0] / 2 - more, -object.size[1] / 2 - more, object.size[0] + 2 * more, object.size[1] + 2 * more);
      else g.arc(0, 0, object.radius + more, 0, 2 * Math.PI);  // of radius 0, where it is less than 0.05 mm
    };
    if (object.hot || object.light) {
      for (const [more, alpha] of [[9, 0.16], [4, 0.3]]) {
        outline(more * pixel);
        g.globalAlpha = alpha;
        g.fillStyle = object.hot ? color('heat') : color('gold-mark');
        g.fill();
      }
      g.globalAlpha = 1;
    }
    outline();
    g.fillStyle = object.color;
    g.fill();
    if (object.z[1] > 0) {
      g.strokeStyle = color('edge');
      g.lineWidth = pixel;
      g.stroke();
    }
    if (object.kind === 'person') {
      g.beginPath();
      g.moveTo(0, 0);
      g.lineTo(object.radius, 0);
      g.strokeStyle = color('surface');
      g.lineWidth = 2 * pixel;
      g.stroke();
    }
  });
}

// Floor, grid, maps, and the objects of a list that never move in it.
export function drawGround(g, view, run, list, isSvg = false) {
  const [left, right, bottom, top] = run.world.bounds;
  const pixel = 1 / view.scale;
  g.save();
  view.apply(g);
  g.fillStyle = color('surface');
  g.beginPath();
  g.rect(left, bottom, right - left, top - bottom);
  g.fill();
  const objects = list ? list.objects.map((object, i) => [object, list.tracks[i]]).filter(([, track]) => !track).map(([object]) => object) : [];
  for (const map of run.world.maps) if (map.height === 0) drawMap(g, map, isSvg);
  for (const object of objects) if (object.z[1] <= 0) drawObject(g, object, object.at, pixel);
  const step = roundUpTo(GRID_PX / view.scale);
  const [x0, y0] = view.toWorld(-view.width, 2 * view.height);
  const [x1, y1] = view.toWorld(2 * view.width, -view.height);
  g.strokeStyle = color('grid');
  g.lineWidth = pixel;
  g.beginPath();
  for (const x of multiplesIn(Math.max(left, x0), Math.min(right, x1), step)) {
    g.moveTo(x, bottom);
    g.lineTo(x, top);
  }
  for (const y of multiplesIn(Math.max(bottom, y0), Math.min(top, y1), step)) {
    g.moveTo(left, y);
    g.lineTo(right, y);
  }
  g.stroke();
  for (const map of run.world.maps) if (map.height > 0) drawMap(g, map, isSvg);
  const standing = objects.filter((object) => object.z[1] > 0).sort((a, b) => a.z[1] - b.z[1]);
  for (const object of standing) drawObject(g, object, object.at, pixel);
  g.strokeStyle = color('line');
  g.lineWidth = pixel;
  g.beginPath();
  g.rect(left, bottom, right - left, top - bottom);
  g.stroke();
  g.restore();
}

// The objects that move.
export function drawMovingObjects(g, view, list, time) {
  if (!list) return;
  const pose = {};
  g.save();
  view.apply(g);
  list.objects.forEach((object, i) => {
    if (list.tracks[i]?.poseAt(time, pose)) drawObject(g, object, [pose.x, pose.y, pose.heading], 1 / view.scale);
  });
  g.restore();
}
