// SPDX-License-Identifier: GPL-2.0-or-later
// The page in English and Japanese. English texts are the keys; names and numbers are the same in both.

const JAPANESE = {
  "Loading the run …": "読み込み中…", Legend: "凡例", Events: "できごと", Play: "再生", Pause: "一時停止", Speed: "速さ", Front: "正面", Side: "側面", Free: "自由",
  Joints: "接合部", "Ground moves": "地面を動かす", Show: "表示", "Slow at the main event": "山場をゆっくり", "House at the start": "最初の形", "Glass walls": "ガラスの壁",
  Playback: "再生の操作", seconds: "秒", "Time in seconds": "時刻（秒）", "the house in 3D. Drag to turn it, or use Shift and the arrow keys.": "家の立体図。ドラッグか Shift と矢印キーで回転",
  Person: "人", "Full screen": "全画面", "Record a film": "動画を録る", "Stop recording": "録画を止める", Close: "閉じる",
  "Keys and explanations": "操作と説明", "Controls and terms": "操作と用語", Time: "時刻", Camera: "カメラ",
  "From the east: south is left, north is right": "東から：左が南、右が北", "From the north: east is left, west is right": "北から：左が東、右が西",
  "Ground acceleration, m/s²": "地動加速度 m/s²", "Storey drift": "層間変形角", "N–S": "南北", "E–W": "東西", "up–down": "上下",
  "force in a joint: none … strength": "接合部の力：なし … 強さ", "joint partly broken": "一部が破断", "joint broken (pale: hidden)": "破断（淡色：陰）", "joint or wall broken (pale: hidden)": "破断（淡色：陰）", "broken before the start": "最初から破断",
  "snow, in rigid slabs": "雪（剛体の板）", roof: "屋根", brace: "筋かい", floor: "床", beam: "梁", column: "柱", sill: "土台", foundation: "基礎", ground: "地面", wall: "壁", "wall partly broken": "壁（一部破断）", "wall broken": "壁（破断）",
  "Click a member or a joint for its load.": "部材か接合部を押すと力が見えます。",
  "Drag to turn the house. Pinch or use the wheel to zoom. Drag with two fingers or the right button to move it. Click a curve, a mark on the time line or an event to go to its time. Click a member or a joint for its load.":
    "ドラッグで回転、ピンチかホイールで拡大、二本指か右ボタンで移動。曲線・時間軸の印・できごとを押すとその時刻へ。部材か接合部を押すと力が見えます。",
  "play, pause": "再生・一時停止", "half a second back, forward": "0.5 秒もどる・進む", "one frame back, forward": "1 コマもどる・進む", "start, end": "最初・最後",
  "previous, next event": "前・次のできごと", "slower, faster": "遅く・速く", "front, side, free camera; next camera": "正面・側面・自由・次のカメラ",
  "turn the house, zoom in, zoom out": "回転・拡大・縮小", "show the ground moving, or fixed": "地面を動かす・止める", "show or hide joints": "接合部の表示", "full screen": "全画面",
  "Storey drift: the sideways displacement of a floor relative to the floor below, divided by the height of the storey. Damage begins at 1/120 and is heavy from 1/30; from 1/10 on the house may fall over. The scale is stretched near zero, and larger drifts are drawn at its border.":
    "層間変形角：ある階の床が下の床に対して横にずれた量を階高で割ったもの。1/120 で損傷が始まり、1/30 で大きな損傷、1/10 を超えると倒れるおそれがあります。目盛はゼロの近くで引き伸ばしてあります。",
  "Members are rigid. Walls are included only where the house file names them; nails and soil are not modelled. Use the model to compare houses, not to certify one.":
    "このモデルの部材は剛体です。壁は家のファイルにあるものだけを含み、釘と地盤は含みません。家を比べるためのもので、安全を保証するものではありません。",
  "no joints": "接合部なし", "of its strength": "（強さに対する比）", "not broken": "破断していない",
  "storey 1": "1 階", "storey 2": "2 階", "storey 3": "3 階", entrance: "玄関", "north side": "北側", "south side": "南側", "east side": "東側", "west side": "西側", inside: "内部",
  "north and east sides": "北東の角", "north and west sides": "北西の角", "south and east sides": "南東の角", "south and west sides": "南西の角",
  "its joints: ": "接合部：", ", ": "、", "largest pull": "最大引張", "largest uplift of the column's foot": "柱脚の最大浮き上がり",
  tension: "引張", compression: "圧縮", shear: "せん断",
  "column-beam joint": "柱と梁の接合部", "brace-beam joint": "筋かいと梁の接合部", "brace-column joint": "筋かいと柱の接合部", "floor-beam joint": "床と梁の接合部", "roof-beam joint": "屋根と梁の接合部", "roof-roof joint": "屋根どうしの接合部", "beam-beam joint": "梁どうしの接合部",
  "wall-beam joint": "壁（梁の間）", "wall-column joint": "壁（柱の間）",
  "No 3D picture: this browser has no WebGL 2. Curves and events work.": "WebGL 2 がないため 3D 表示はできません。曲線とできごとは使えます。",
};

let language = "en";
const listeners = [];

/** A text of the page in the current language. */
export const tr = (text) => (language === "ja" ? (JAPANESE[text] ?? text) : text);

/** Whichever of two texts the current language needs; the English one when the other is missing. */
export const either = (english, japanese) => (language === "ja" && japanese ? japanese : english);

/** 'storey 2' */
export const storeyName = (number) => (language === "ja" ? `${number} 階` : `storey ${number}`);

export const current = () => language;

/** Call a function now and whenever the language changes. */
export function translated(show) {
  listeners.push(show);
  show();
}

/** Change the language: "en" or "ja". */
export function speak(name) {
  language = name === "ja" ? "ja" : "en";
  document.documentElement.lang = language;
  for (const place of document.querySelectorAll("[data-t]")) translate(place);
  for (const show of listeners) show();
}

/** Static texts of the page: the text of an element, or the attributes that `data-t` names. */
function translate(place) {
  const names = place.dataset.t ? place.dataset.t.split(" ") : ["text"];
  for (const name of names) {
    const key = `english-${name}`;
    if (!place.hasAttribute(`data-${key}`)) place.setAttribute(`data-${key}`, name === "text" ? place.textContent : place.getAttribute(name));
    const shown = tr(place.getAttribute(`data-${key}`));
    if (name === "text") place.textContent = shown;
    else place.setAttribute(name, shown);
  }
}
