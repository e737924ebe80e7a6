// SPDX-License-Identifier: GPL-3.0-or-later
// The studio: a face that answers while its parameters are changed.
import '../page/style.css';
import { at, startPage } from '../page/dom';

startPage(() => {
  at('title').textContent = document.title;
});
