// lesson_exercises: the twenty exercises, [{ id, title, source, make }]. make(random) makes an instance with fresh numbers (see
// lesson_exercise.mjs); random() returns a number from 0 to below 1, as Math.random does.
import { exercisesEece } from './lesson_exercise_eece.mjs';
import { exercisesHaw } from './lesson_exercise_haw.mjs';
import { exercisesKaist } from './lesson_exercise_kaist.mjs';
import { exercisesLmu } from './lesson_exercise_lmu.mjs';
import { exercisesPipeline } from './lesson_exercise_pipeline.mjs';

export const exercises = [...exercisesHaw, ...exercisesPipeline, ...exercisesKaist, ...exercisesEece, ...exercisesLmu];
