/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/strips.h"

#include <pthread.h>
#include <stdlib.h>

#ifdef _OPENMP
#include <omp.h>
#endif

int strips_threads(int wanted) {
#ifdef _OPENMP
    return wanted > 0 ? wanted : omp_get_max_threads();
#else
    return wanted > 0 ? wanted : 1;
#endif
}

/* The state that the threads share, under the lock. */
typedef struct queue {
    const strips *s;
    pthread_mutex_t lock;
    pthread_cond_t room;
    size_t next, taken; /* strips */
    bool taking, stopped;
    bool *made; /* slots that wait to be taken */
    int started;
} queue;

/* Whoever made the strip that comes next takes it, and what others made meanwhile. The lock is held, but not in take().
 */
static void take_made(queue *q) {
    const strips *s = q->s;
    while (!q->taking && !q->stopped && q->taken < s->count && q->made[q->taken % s->slots]) {
        const size_t index = q->taken, slot = index % s->slots;
        q->taking = true;
        pthread_mutex_unlock(&q->lock);
        const bool good = s->take(s->context, index, slot);
        pthread_mutex_lock(&q->lock);
        q->taking = q->made[slot] = false;
        q->taken++;
        q->stopped = q->stopped || !good;
        pthread_cond_broadcast(&q->room);
    }
}

static void *work(void *shared) {
    queue *q = shared;
    const strips *s = q->s;
    pthread_mutex_lock(&q->lock);
    const int thread = q->started++;
    for (;;) {
        while (s->take != NULL && !q->stopped && q->next < s->count && q->next >= q->taken + s->slots)
            pthread_cond_wait(&q->room, &q->lock);
        if (q->stopped || q->next == s->count)
            break;
        const size_t index = q->next++, slot = s->take != NULL ? index % s->slots : 0;
        pthread_mutex_unlock(&q->lock);
        s->make(s->context, index, slot, thread);
        pthread_mutex_lock(&q->lock);
        if (s->take != NULL) {
            q->made[slot] = true;
            take_made(q);
        }
    }
    pthread_mutex_unlock(&q->lock);
    return NULL;
}

/* Where no more threads can be had, fewer do it all. */
bool strips_run(const strips *s) {
    const int most = s->count < (size_t)s->threads ? (int)s->count : s->threads;
    queue q = {.s = s, .lock = PTHREAD_MUTEX_INITIALIZER, .room = PTHREAD_COND_INITIALIZER};
    pthread_t *others = malloc(((size_t)most + 1) * sizeof *others);
    q.made = calloc(s->slots + 1, sizeof *q.made);
    const bool good = others != NULL && q.made != NULL;
    int running = 0;
    while (good && running + 1 < most && pthread_create(&others[running], NULL, work, &q) == 0)
        running++;
    if (good)
        work(&q);
    for (int i = 0; i < running; i++)
        pthread_join(others[i], NULL);
    free(others);
    free(q.made);
    return good && !q.stopped;
}
