// Who takes the place on a column, and how high that is: decided from where all are before anyone moves. Include it after
// include/ground.glsl and the declarations of `top_id`, `way` and `claim`, of each texel.
#ifndef COLUMNS_GLSL
#define COLUMNS_GLSL

ivec2 end_of_way(ivec2 texel, uint its_way) { return neighbor_of(texel, its_way & 15u); }

// Whether a column's top is about to leave it.
bool loses_top(ivec2 texel)
{
    uint here = index_of(texel);
    uint its_way = way[here];
    bool slides = its_way < WAY_TAKEN && its_way != WAY_NONE && claim[index_of(end_of_way(texel, its_way))] == top_id[here];
    return slides || its_way >= WAY_TAKEN;
}

// m above the floor, of who comes to lie on a column.
float next_height(ivec2 texel) { return ground_at(texel).top + (loses_top(texel) ? 0.0 : params.spacing); }

#endif
